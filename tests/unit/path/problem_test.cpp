#include "outrider/path/problem.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

/// The bounds of a world are sums of lengths: 0.3 - (0.1 + 0.2) is no 0.
TEST(Problem, NumbersOfItsSentencesAreRounded) {
  const GridFrame frame{{0.3 - (0.1 + 0.2), -8.881784197001252e-16}, 0.1, 3, 3};
  const auto ground = GridMap::of(Grid<std::uint8_t>(frame), GridModel::cells);
  ASSERT_TRUE(ground);
  ASSERT_NE(frame.bounds().low.y, 0.0);
  const Problem problem{
      std::make_shared<const GridMap>(*ground), {0.1 + 0.2 + 5.0, 0.1}, {0.1, 0.1}, nullptr};
  const auto query = grid_query(problem);
  ASSERT_FALSE(query);
  EXPECT_EQ(query.error().sentence,
            "the start (5.3, 0.1) lies outside the map; take x from 0 to 0.3 and y from 0 to 0.3");
}

}  // namespace
}  // namespace outrider
