#include "steering/motions/outline_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outline_way.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"
#include "steering/outline_room.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

/// A robot somewhere on a grid, on a leg or an arc, also about a point in itself.
struct Case {
  std::vector<Vec2> outline;
  PathPiece piece;
  double heading_rad = 0.0;
};

Case random_case(Rng& rng, const GridFrame& frame) {
  Case made;
  made.outline = testing::random_outline(rng, rng.uniform(0.2, 3.0));
  if (rng.below(8) == 0) made.outline = {Vec2{}};
  made.heading_rad = rng.uniform(-pi, pi);
  const Vec2 from{rng.uniform(0.0, frame.width), rng.uniform(0.0, frame.height)};
  const Vec2 ahead = direction(made.heading_rad);
  made.piece = {from, from + rng.uniform(-4.0, 4.0) * ahead, {}, 0.0};
  if (rng.below(4) == 0) return made;
  const double radius = rng.uniform(-4.0, 4.0);
  made.piece.centre = from + radius * perpendicular(ahead);
  made.piece.turn_rad = rng.uniform(0.01, rng.below(2) == 0 ? 0.8 : 6.2) * (rng.below(2) == 0 ? 1.0 : -1.0);
  made.piece.to = made.piece.centre + rotated(made.piece.turn_rad, from - made.piece.centre);
  return made;
}

/// The least distance of poses close together, which is at most 0.02 more than the true one.
double by_dense_poses(const Case& robot, Cell cell) {
  const Vec2 low{double(cell.x), double(cell.y)};
  const RoundedPolygon square{{low, low + Vec2{1.0, 0.0}, low + Vec2{1.0, 1.0}, low + Vec2{0.0, 1.0}}, 0.0};
  double outer = 0.0, least = 1e9;
  for (const Vec2 corner : robot.outline) outer = std::max(outer, norm(corner));
  const double moved = length_of(robot.piece) + outer * std::abs(robot.piece.turn_rad);
  const int steps = 1 + static_cast<int>(moved / 0.02);
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    const Pose2 pose{point_on(robot.piece, part), robot.heading_rad + part * robot.piece.turn_rad};
    std::vector<Vec2> placed;
    for (const Vec2 corner : robot.outline) placed.push_back(pose * corner);
    least = std::min(least, signed_distance(low, {placed, 0.0}));
    for (std::size_t k = 0; k < placed.size(); ++k)
      least = std::min(least, signed_distance(Segment{placed[k], placed[(k + 1) % placed.size()]}, square));
  }
  return std::max(0.0, least);
}

TEST(OutlineSweep, TheJudgeAgreesWithDensePoses) {
  Rng rng = Rng(5).child("judge");
  const GridFrame frame{{}, 1.0, 9, 9};
  int touching = 0;
  for (int i = 0; i < testing::cases(400); ++i) {
    const Case robot = random_case(rng, frame);
    const OutlineWay way(robot.piece, robot.heading_rad, robot.outline, frame);
    for (int k = 0; k < 12; ++k) {
      const Cell cell{static_cast<int>(rng.below(15)) - 3, static_cast<int>(rng.below(15)) - 3};
      const double gap = way.gap(cell), dense = by_dense_poses(robot, cell);
      EXPECT_LE(gap, dense + 1e-9) << "case " << i;
      EXPECT_GE(gap, dense - 0.0201) << "case " << i;
      EXPECT_TRUE(way.may_come_to(cell, gap + 1e-9)) << "case " << i;
      touching += gap == 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(touching, testing::cases(300));
}

TEST(OutlineSweep, ClearsAndTouchesAsTheJudgeSays) {
  Rng rng = Rng(7).child("sweep");
  int clear = 0, blocked = 0;
  for (int i = 0; i < testing::cases(2'000); ++i) {
    Grid<std::uint8_t> grid = strewn(rng, 12, 12, rng.uniform(0.0, 0.15));
    const GridMap ground = *GridMap::of(grid, GridModel::cells);
    const Case robot = random_case(rng, grid.frame);
    const OutlineWay way(robot.piece, robot.heading_rad, robot.outline, grid.frame);
    double apart = 1e9;
    const Box2 near = way.bounds().grown(1.0);
    for (int y = static_cast<int>(std::floor(near.low.y)); y <= near.high.y; ++y) {
      for (int x = static_cast<int>(std::floor(near.low.x)); x <= near.high.x; ++x) {
        if (ground.blocked({x, y})) apart = std::min(apart, way.gap({x, y}));
      }
    }
    if (apart > 0.0 && apart < 1e-6) continue;
    std::vector<MonotonePart> border;
    const OutlineSweep sweep{robot.outline, robot.piece, robot.heading_rad};
    add_border_parts(sweep, border);
    ASSERT_EQ(clear_of_cells(ground, sweep, border, {}), apart > 0.0)
        << "case " << i << ", " << apart << " apart";
    ++(apart > 0.0 ? clear : blocked);
    OutlineRoom room;
    ASSERT_TRUE(room.begin(ground, robot.outline, {}).has_value());
    if (room.is_wide(robot.piece.from, length_of(robot.piece))) {
      EXPECT_GT(apart, 0.0) << "case " << i;
    }
    if (robot.outline.size() > 1 && room.is_blocked(robot.piece.from)) {
      EXPECT_EQ(apart, 0.0) << "case " << i;
    }
  }
  EXPECT_GT(clear, testing::cases(150));
  EXPECT_GT(blocked, testing::cases(150));
}

TEST(OutlineSweep, TouchesTheCellsThatTheJudgeNames) {
  Rng rng = Rng(8).child("cells");
  const GridFrame frame{{}, 1.0, 9, 9};
  for (int i = 0; i < testing::cases(500); ++i) {
    const Case robot = random_case(rng, frame);
    const OutlineWay way(robot.piece, robot.heading_rad, robot.outline, frame);
    std::vector<Cell> cells;
    add_touched_cells({robot.outline, robot.piece, robot.heading_rad}, cells);
    for (int y = -12; y < 22; ++y) {
      for (int x = -12; x < 22; ++x) {
        const double apart = way.gap({x, y});
        if (apart > 0.0 && apart < 1e-6) continue;
        const bool touched = std::ranges::find(cells, Cell{x, y}) != cells.end();
        ASSERT_EQ(touched, apart == 0.0)
            << "case " << i << ": " << x << " " << y << ", " << apart << " apart";
      }
    }
  }
}

}  // namespace
}  // namespace outrider
