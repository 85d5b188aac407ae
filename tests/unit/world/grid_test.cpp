#include "outrider/world/grid.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

TEST(GridFrame, CellsIndicesAndPointsConvertBothWays) {
  const GridFrame frame{{-1.0, 2.0}, 0.25, 13, 7};
  EXPECT_EQ(frame.size(), 91U);
  std::size_t index = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x, ++index) {
      const Cell cell{x, y};
      EXPECT_EQ(frame.index(cell), index) << "row by row from the lowest";
      EXPECT_EQ(frame.cell(index), cell);
      EXPECT_EQ(frame.cell_at(frame.centre(cell)), cell);
      EXPECT_EQ(frame.cell_at(frame.corner(cell)), cell) << "a corner belongs to the cell above right";
      EXPECT_TRUE(frame.contains(cell));
    }
  }
  for (const Cell outside : {Cell{-1, 0}, Cell{0, -1}, Cell{13, 0}, Cell{0, 7}}) {
    EXPECT_FALSE(frame.contains(outside));
  }
  EXPECT_EQ(frame.cell_at({-1.001, 1.999}), (Cell{-1, -1}));
  EXPECT_EQ(frame.bounds().high, (Vec2{2.25, 3.75}));
}

TEST(GridFrame, CoveringIsCentredAndTheSmallest) {
  Rng rng(1);
  for (int i = 0; i < 500; ++i) {
    const Vec2 low{rng.uniform(-5, 5), rng.uniform(-5, 5)};
    const Box2 box{low, low + Vec2{rng.uniform(0.1, 5), rng.uniform(0.1, 5)}};
    const double resolution = rng.uniform(0.05, 1.0);
    const GridFrame frame = covering(box, resolution);
    const Box2 covered = frame.bounds();
    EXPECT_LE(covered.low.x, box.low.x + 1e-6);
    EXPECT_LE(covered.low.y, box.low.y + 1e-6);
    EXPECT_GE(covered.high.x, box.high.x - 1e-6);
    EXPECT_GE(covered.high.y, box.high.y - 1e-6);
    EXPECT_LT((frame.width - 1) * resolution, box.size().x);
    EXPECT_LT((frame.height - 1) * resolution, box.size().y);
    EXPECT_NEAR(covered.low.x + covered.high.x, box.low.x + box.high.x, 1e-9);
    EXPECT_NEAR(covered.low.y + covered.high.y, box.low.y + box.high.y, 1e-9);
  }
  EXPECT_EQ(covering({{-10, -10}, {10, 10}}, 0.1).width, 200) << "rounding adds no column";
}

TEST(GridFrame, CellsMoveWithTheirValues) {
  Rng rng(2);
  const auto side = [&] { return static_cast<int>(rng.below(6)); };
  for (int i = 0; i < 200; ++i) {
    const GridFrame from{{}, 1.0, side(), side()}, to{{}, 1.0, side(), side()};
    const Cell shift{side() - 3, side() - 3};
    std::vector<int> cells(from.size());
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = static_cast<int>(k);
    const std::vector<int> moved = moved_cells(cells, from, to, shift, -1);
    ASSERT_EQ(moved.size(), to.size());
    for (std::size_t k = 0; k < moved.size(); ++k) {
      const Cell before{to.cell(k).x - shift.x, to.cell(k).y - shift.y};
      EXPECT_EQ(moved[k], from.contains(before) ? cells[from.index(before)] : -1);
    }
  }
}

TEST(Grid, HoldsAValueACell) {
  Grid<int> grid(GridFrame{{0, 0}, 1.0, 3, 2}, 7);
  EXPECT_EQ((grid[{2, 1}]), 7);
  grid[{2, 1}] = 9;
  EXPECT_EQ(grid.cells, (std::vector<int>{7, 7, 7, 7, 7, 9}));
  EXPECT_TRUE(grid.contains({2, 1}));
  EXPECT_FALSE(grid.contains({3, 1}));
}

}  // namespace
}  // namespace outrider
