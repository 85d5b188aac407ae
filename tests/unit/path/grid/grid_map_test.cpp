#include "outrider/path/grid/grid_map.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "outrider/path/grid/line_of_sight.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

std::vector<Cell> places(const GridMap& ground) {
  std::vector<Cell> all;
  for (int y = 0; y <= ground.frame.height; ++y) {
    for (int x = 0; x <= ground.frame.width; ++x) {
      if (ground.place({x, y})) all.push_back({x, y});
    }
  }
  return all;
}

class BothModels : public testing::TestWithParam<GridModel> {};
INSTANTIATE_TEST_SUITE_P(Models, BothModels, testing::Values(GridModel::cells, GridModel::corners),
                         [](const auto& model) { return std::string(to_string(model.param)); });

TEST_P(BothModels, PlacesPinchesMovesAndSightAreThoseOfTheDefinition) {
  Rng rng = Rng(2).child("sight");
  for (int i = 0; i < 400; ++i) {
    const auto grid = random_grid(rng, i % 8 == 0 ? 11 : 6);
    const auto ground = GridMap::of(grid, GetParam());
    ASSERT_TRUE(ground.has_value());
    for (int y = -1; y <= grid.frame.height + 1; ++y) {
      for (int x = -1; x <= grid.frame.width + 1; ++x) {
        const Cell v{x, y};
        ASSERT_EQ(ground->blocked(v), oracle::blocked(grid, x, y));
        if (!ground->contains(v)) continue;
        ASSERT_EQ(ground->place(v), oracle::place(grid, GetParam(), v));
        ASSERT_EQ(ground->pinch(v), GetParam() == GridModel::corners && oracle::pinch(grid, v));
      }
    }
    const auto all = places(*ground);
    for (const Cell a : all) {
      for (unsigned k = 0; k < 8; ++k) {
        const Cell b{a.x + grid_moves[k].x, a.y + grid_moves[k].y};
        const bool legal = ground->place(b) && oracle::legal(grid, GetParam(), a, b);
        ASSERT_EQ((ground->moves[ground->index(a)] >> k & 1U) != 0, legal) << "grid " << i;
      }
      for (const Cell b : all) {
        ASSERT_EQ(visible(*ground, a, b), oracle::legal(grid, GetParam(), a, b))
            << "grid " << i << " (" << a.x << ", " << a.y << ") to (" << b.x << ", " << b.y << ")";
      }
    }
  }
}

TEST_P(BothModels, PointsAndVerticesBelongTogether) {
  GridFrame frame{{-3.7, 12.1}, 0.05, 40, 23};
  const auto ground = GridMap::of(Grid<std::uint8_t>(frame), GetParam());
  ASSERT_TRUE(ground.has_value());
  for (const Cell v : places(*ground)) EXPECT_EQ(ground->vertex_at(ground->point(v)), v);
  EXPECT_FALSE(ground->vertex_at({-3.8, 12.2}));
  EXPECT_FALSE(ground->vertex_at({std::numeric_limits<double>::quiet_NaN(), 12.2}));
  EXPECT_FALSE(ground->vertex_at({-3.7, 1e308}));
}

TEST(GridMap, IndexesBothWays) {
  const auto ground = GridMap::of(Grid<std::uint8_t>(GridFrame{{}, 1.0, 5, 3}), GridModel::corners);
  for (int y = -1; y <= 3; ++y) {
    for (int x = -1; x <= 5; ++x) EXPECT_EQ(ground->at(ground->index({x, y})), (Cell{x, y}));
  }
}

TEST(GridMap, RefusesFramesThatMakeNoGrid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const GridFrame& frame :
       {GridFrame{{}, 1.0, 0, 3}, GridFrame{{}, 1.0, -2, -2}, GridFrame{{}, 0.0, 2, 2},
        GridFrame{{}, nan, 2, 2}, GridFrame{{nan, 0.0}, 1.0, 2, 2}, GridFrame{{}, 1.0, 1 << 20, 1 << 20},
        GridFrame{{}, 1.0, 1 << 21, 1}}) {
    EXPECT_FALSE(check_frame(frame).has_value());
    Grid<std::uint8_t> grid;
    grid.frame = frame;
    EXPECT_FALSE(GridMap::of(grid, GridModel::cells).has_value());
  }
  Grid<std::uint8_t> short_of_cells(GridFrame{{}, 1.0, 3, 3});
  short_of_cells.cells.pop_back();
  EXPECT_FALSE(GridMap::of(short_of_cells, GridModel::cells).has_value());
}

}  // namespace
}  // namespace outrider
