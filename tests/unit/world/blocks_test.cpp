#include "outrider/world/blocks.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

TEST(Blocks, CoverEachCellThatIsNotFreeOnce) {
  Rng rng(3);
  for (int round = 0; round < testing::cases(50); ++round) {
    const GridFrame frame{
        {-0.35, 0.2}, 0.05, static_cast<int>(1 + rng.below(12)), static_cast<int>(1 + rng.below(12))};
    Grid<std::uint8_t> grid(frame);
    const double share = rng.uniform();
    for (auto& cell : grid.cells) {
      if (rng.uniform() < share) cell = rng.below(2) == 0 ? occupied_cell : unknown_cell;
    }
    std::vector<int> covered(frame.size(), 0);
    for (const Solid& solid : blocks(grid, -0.1, 2.0)) {
      const Box3 box = bounds(solid);
      EXPECT_NEAR(box.low.z, -0.1, 1e-12);
      EXPECT_NEAR(box.high.z, 2.0, 1e-12);
      for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec2 p = frame.centre(frame.cell(i));
        covered[i] += p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y ? 1 : 0;
      }
    }
    for (std::size_t i = 0; i < frame.size(); ++i) {
      ASSERT_EQ(covered[i], grid.cells[i] == free_cell ? 0 : 1) << "cell " << i << " of round " << round;
    }
  }
}

TEST(Blocks, ABorderLeavesTheMapWhereItIs) {
  Grid<std::uint8_t> grid({{1.0, -2.0}, 0.5, 2, 1});
  grid.cells = {occupied_cell, free_cell};
  const Grid<std::uint8_t> wide = bordered(grid, unknown_cell);
  EXPECT_EQ(wide.cells, (std::vector<std::uint8_t>{2, 2, 2, 2, 2, 1, 0, 2, 2, 2, 2, 2}));
  EXPECT_EQ(wide.frame.centre({1, 1}), grid.frame.centre({0, 0}));
  EXPECT_EQ(wide.frame.resolution_m, 0.5);
}

TEST(Blocks, OfAFullMapAreOne) {
  const Grid<std::uint8_t> grid({{0.0, 0.0}, 0.1, 30, 20}, unknown_cell);
  ASSERT_EQ(blocks(grid, 0.0, 1.0).size(), 1U);
}

}  // namespace
}  // namespace outrider
