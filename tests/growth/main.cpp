// The tests of growth; with --table, the table of docs/benchmarks/growth.md instead.
#include <gtest/gtest.h>

#include <cstdio>
#include <string_view>

#include "subject.hpp"

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--table") {
    std::fputs(outrider::growth::table().c_str(), stdout);
    return 0;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
