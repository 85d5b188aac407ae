#include "outrider/navigate/curved_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/path/pieces.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr double cell_m = 0.05;

/// Points of the surfaces that a laser sees: thin walls, one of them close to the start.
std::vector<Vec2> random_walls(Rng& rng, const GridFrame& frame) {
  std::vector<Vec2> places;
  for (int i = 0; i < 6; ++i) {
    const Vec2 from = testing::random_point(rng, 2.8), along = direction(rng.uniform(-pi, pi));
    const double length = rng.uniform(0.2, 2.0);
    for (double at = 0.0; at < length; at += 0.5 * cell_m) {
      const Vec2 place = from + at * along;
      if (frame.contains(frame.cell_at(place))) places.push_back(place);
    }
  }
  return places;
}

double gap_to(const std::vector<Vec2>& places, const Footprint& footprint, const Pose2& pose) {
  double least = 10.0;
  for (const Vec2 place : places) least = std::min(least, footprint.gap_m(pose.to_local(place)));
  return least;
}

/// Dense poses on the way say that it keeps the margin, near its ends what the robot has there to a cell,
/// and never goes through a wall.
TEST(CurvedWay, KeepsItsFootprintFromWhatIsMarked) {
  Rng rng = Rng(3).child("ways");
  Workspace workspace;
  int found = 0, narrow = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    GoalGround ground;
    ground.frame = {{-3.0, -3.0}, cell_m, 120, 120};
    ground.obstacles = random_walls(rng, ground.frame);
    const Footprint footprint =
        i % 4 == 0 ? Footprint::disk(0.2) : Footprint({testing::random_outline(rng, 0.4), 0.05 * (i % 2)});
    RobotModel robot;
    robot.turning_radius_m = rng.uniform(0.3, 0.8);
    CurveQuery query;
    query.start = {testing::random_point(rng, 2.2), rng.uniform(-pi, pi)};
    query.goal = testing::random_point(rng, 2.2);
    if (rng.below(2) == 0) query.heading_rad = rng.uniform(-pi, pi);
    const double at_start = gap_to(ground.obstacles, footprint, query.start);
    if (at_start < 0.005) continue;
    const auto way = plan_curved_way(ground, footprint, robot, query, workspace);
    if (!way || way->empty()) continue;
    ++found;
    narrow += at_start < query.margin_m ? 1 : 0;
    const Vec2 end = way->back().to;
    EXPECT_LE(distance(end, query.goal), query.within_m + 1e-9);
    for (const PathPiece& piece : *way) {
      const int steps = 1 + static_cast<int>(length_of(piece) / 0.01);
      for (int k = 0; k <= steps; ++k) {
        const double part = static_cast<double>(k) / steps;
        const Pose2 pose{point_on(piece, part), heading_in(piece) + part * piece.turn_rad};
        const double gap = gap_to(ground.obstacles, footprint, pose);
        const double from_ends =
            std::min(distance(pose.position, query.start.position), distance(pose.position, end));
        const bool is_near = from_ends < 1.0 + footprint.outer_m();
        EXPECT_GE(gap, is_near ? std::min(at_start, query.margin_m) - 2.0 * cell_m : query.margin_m)
            << "case " << i;
        EXPECT_GT(gap, -0.5 * cell_m) << "case " << i << ": through a wall";
      }
    }
  }
  EXPECT_GT(found, testing::cases(16));
  EXPECT_GT(narrow, 0);
}

}  // namespace
}  // namespace outrider
