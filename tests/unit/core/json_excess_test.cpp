#include "outrider/core/json_excess.hpp"

#include <gtest/gtest.h>

#include <string>

namespace outrider {
namespace {

TEST(JsonExcess, DeepNestingAndManyValues) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(json_excess(nested(100)), "");
  EXPECT_EQ(json_excess(nested(101)), "its JSON nests more than 100 deep");
  EXPECT_EQ(json_excess("{\"a\": \"\\\"" + std::string(200, '[') + "\"}"), "") << "in a text";
  EXPECT_EQ(json_excess(std::string(200, ']')), "") << "the parser refuses it";
  std::string list = "[0";
  for (int i = 0; i < 4'000'000; ++i) list += ",0";
  EXPECT_EQ(json_excess(list + "]"), "its JSON has more than 4,000,000 values");
  EXPECT_EQ(json_excess(std::string_view(list).substr(0, 6'000'000)), "");
}

}  // namespace
}  // namespace outrider
