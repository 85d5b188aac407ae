#include "outrider/core/parallel.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace outrider {
namespace {

TEST(ParallelFor, CallsEachBodyOnce) {
  for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
    std::vector<int> calls(count, 0);
    parallel_for(count, [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(count, 1));
  }
}

TEST(ParallelFor, LeavesResultsInTheirPlaces) {
  std::vector<std::size_t> squares(500);
  parallel_for(squares.size(), [&](std::size_t i) { squares[i] = i * i; });
  for (std::size_t i = 0; i < squares.size(); ++i) EXPECT_EQ(squares[i], i * i);
}

}  // namespace
}  // namespace outrider
