#include "steering/corner_distances.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/grid_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

TEST(CornerDistances, BoundTheShortestLegsFromBothSides) {
  Rng rng = Rng(4).child("corners");
  CornerDistances kept;
  int joined = 0, apart = 0;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const auto grid = random_grid(rng, 7);
    const GridMap ground = *GridMap::of(grid, GridModel::cells);
    const auto cell = [&] {
      return Cell{static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.width))),
                  static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.height)))};
    };
    const Cell start = cell(), goal = cell();
    if (grid[start] != 0 || grid[goal] != 0) continue;
    const Status begun = kept.begin(ground, grid.frame.centre(goal), grid.frame.centre(start), {});
    ASSERT_EQ(begun.has_value(), std::isfinite(kept.at(grid.frame.centre(start))));
    for (int k = 0; k < 4; ++k) {
      const Cell from = k == 0 ? start : cell();
      if (grid[from] != 0) continue;
      const double least = oracle::shortest(grid, GridModel::cells, from, goal, true);
      const double length = kept.at(grid.frame.centre(from)),
                   bound = kept.lower_bound(grid.frame.centre(from));
      ASSERT_EQ(std::isfinite(length), std::isfinite(least)) << "grid " << i;
      ++(std::isfinite(least) ? joined : apart);
      if (!std::isfinite(least)) continue;
      EXPECT_LE(bound, least + 1e-9) << "grid " << i;
      EXPECT_LE(length, 1.0824 * least + 2.0) << "grid " << i;
      EXPECT_GE(length, bound);
    }
  }
  EXPECT_GT(joined, testing::cases(1000));
  EXPECT_GT(apart, testing::cases(100));
}

TEST(CornerDistances, OneRowOfCells) {
  const GridMap ground = *GridMap::of(drawn({"....."}), GridModel::cells);
  CornerDistances distances;
  ASSERT_TRUE(distances.begin(ground, {4.5, 0.5}, {0.5, 0.5}, {}));
  EXPECT_DOUBLE_EQ(distances.lower_bound({0.5, 0.5}), 4.0) << "the straight distance";
  EXPECT_NEAR(distances.at({0.5, 0.5}), 3.0 + 2.0 * std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace outrider
