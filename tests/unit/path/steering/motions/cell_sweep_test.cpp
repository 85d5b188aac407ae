#include "steering/motions/cell_sweep.hpp"

#include <gtest/gtest.h>

#include <array>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"
#include "visibility/polygon_ground_check.hpp"

namespace outrider {
namespace {

/// The distance between a piece and what is blocked, by the exact distances of the judge: of all cells, and
/// of a border of cells around the grid.
double distance_to_blocked(const GridMap& ground, const PathPiece& piece) {
  double least = 1e9;
  for (int y = -1; y <= ground.frame.height; ++y) {
    for (int x = -1; x <= ground.frame.width; ++x) {
      if (!ground.blocked({x, y})) continue;
      const Vec2 low{double(x), double(y)}, high{x + 1.0, y + 1.0};
      if (Box2{low, high}.contains(piece.from)) return 0.0;
      const std::array<Vec2, 4> corners = {low, Vec2{high.x, low.y}, high, Vec2{low.x, high.y}};
      for (std::size_t i = 0; i < 4; ++i)
        least = std::min(least, distance_to(piece, Segment{corners[i], corners[(i + 1) % 4]}));
    }
  }
  return least;
}

PathPiece random_piece(Rng& rng, const GridFrame& frame) {
  const Vec2 from{rng.uniform(0.0, frame.width), rng.uniform(0.0, frame.height)};
  if (rng.below(4) == 0) return {from, from + testing::random_point(rng, 4.0), {}, 0.0};
  PathPiece arc{from, {}, from + testing::random_point(rng, 3.0), rng.uniform(-6.2, 6.2)};
  arc.to = arc.centre + rotated(arc.turn_rad, arc.from - arc.centre);
  return arc;
}

TEST(CellSweep, AgreesWithExactDistances) {
  Rng rng = Rng(3).child("sweep");
  int clear = 0, blocked = 0;
  for (int i = 0; i < testing::cases(20'000); ++i) {
    auto grid = random_grid(rng, 9);
    if (i % 2 == 0) {
      for (std::uint8_t& cell : grid.cells) cell = cell != 0 && rng.below(8) == 0 ? 1 : 0;
    }
    const GridMap ground = *GridMap::of(grid, GridModel::cells);
    const PathPiece piece = random_piece(rng, grid.frame);
    const double apart = distance_to_blocked(ground, piece);
    if (apart > 0.0 && apart < 1e-6) continue;
    ASSERT_EQ(clear_of_cells(ground, piece), apart > 0.0) << "case " << i << ", " << apart << " apart";
    ++(apart > 0.0 ? clear : blocked);
  }
  EXPECT_GT(clear, testing::cases(1000));
  EXPECT_GT(blocked, testing::cases(1000));
}

TEST(CellSweep, TouchingIsTooNear) {
  const GridMap ground = *GridMap::of(drawn({".....", "..#..", "....."}), GridModel::cells);
  EXPECT_FALSE(clear_of_cells(ground, PathPiece{{0.5, 1.0}, {4.5, 1.0}, {}, 0.0})) << "along its side";
  EXPECT_TRUE(clear_of_cells(ground, PathPiece{{0.5, 0.999}, {4.5, 0.999}, {}, 0.0}));
  EXPECT_FALSE(clear_of_cells(ground, PathPiece{{1.0, 0.0}, {1.0, 0.5}, {}, 0.0})) << "the edge of the grid";
  const Vec2 centre{1.25, 0.25}, corner = Vec2{2.0, 1.0} - centre;
  EXPECT_FALSE(clear_of_cells(
      ground, PathPiece{centre + rotated(-0.3, corner), centre + rotated(0.3, corner), centre, 0.6}))
      << "an arc through its corner";
  EXPECT_FALSE(clear_of_cells(ground, PathPiece{{1.5, 0.5}, {2.5, 0.5}, {2.0, 0.5}, -pi}))
      << "half a circle whose top touches";
  const GridMap pinch = *GridMap::of(drawn({".#", "#."}), GridModel::cells);
  EXPECT_FALSE(clear_of_cells(pinch, PathPiece{{0.5, 1.5}, {1.5, 0.5}, {}, 0.0}));
}

}  // namespace
}  // namespace outrider
