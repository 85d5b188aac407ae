#include "scan/grid_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

Grid<std::uint8_t> free_grid(int width, int height) {
  GridFrame frame;
  frame.origin = {1.0, 2.0};
  frame.resolution_m = 0.05;
  frame.width = width;
  frame.height = height;
  return Grid<std::uint8_t>(frame, free_cell);
}

TEST(GridSurface, AThickWallFacesTheFreeSide) {
  Grid<std::uint8_t> grid = free_grid(40, 30);
  for (int y = 20; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) grid[{x, y}] = y < 22 ? occupied_cell : unknown_cell;
  }
  const Surface surface = surface_of(grid);
  EXPECT_EQ(surface.size(), 40U) << "a point for each cell that borders on a free one";
  for (const SurfacePoint& point : surface) {
    EXPECT_LT(point.normal.y, -0.99);
    EXPECT_NEAR(point.position.y, 2.0 + 21 * 0.05, 0.026) << "on the line through the occupied cells";
  }
}

TEST(GridSurface, AFilledWallIsWhereItsCellsEnd) {
  Grid<std::uint8_t> grid = free_grid(40, 30);
  for (int y = 20; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) grid[{x, y}] = occupied_cell;
  }
  const Surface surface = surface_of(grid);
  EXPECT_EQ(surface.size(), 40U);
  std::size_t lines = 0;
  for (const SurfacePoint& point : surface) {
    if (point.normal == Vec2{}) continue;  // at the corners
    ++lines;
    EXPECT_NEAR(point.position.y, 2.0 + 20 * 0.05, 0.005);
  }
  EXPECT_GT(lines, 30U);
}

TEST(GridSurface, AThinWallHasTwoSides) {
  Grid<std::uint8_t> grid = free_grid(60, 60);
  for (int i = 5; i < 55; ++i) grid[{i, i}] = grid[{i, i + 1}] = occupied_cell;  // at 45 degrees
  const Surface surface = surface_of(grid);
  const auto facing = [&](Vec2 way) {
    return std::ranges::count_if(surface, [&](const SurfacePoint& p) { return dot(p.normal, way) > 0.97; });
  };
  const double half = std::sqrt(0.5);
  EXPECT_GT(facing({half, -half}), 80);
  EXPECT_GT(facing({-half, half}), 80);
}

TEST(GridSurface, ASpeckHasNoNormalAndNothingHasNoSurface) {
  Grid<std::uint8_t> grid = free_grid(20, 20);
  EXPECT_TRUE(surface_of(grid).empty());
  grid[{10, 10}] = occupied_cell;
  const Surface surface = surface_of(grid);
  ASSERT_EQ(surface.size(), 1U);
  EXPECT_EQ(surface[0].normal, Vec2{});
  EXPECT_EQ(surface[0].position, grid.frame.centre({10, 10}));
}

}  // namespace
}  // namespace outrider
