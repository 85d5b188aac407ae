#include "outrider/path/safety.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/pieces.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

CollisionMap random_world(Rng& rng) {
  std::vector<RoundedPolygon> things;
  for (int i = 0; i < 6; ++i) {
    things.push_back(testing::random_rounded_polygon(rng, 0.6));
    const Vec2 by = testing::random_point(rng, 6.0);
    for (Vec2& corner : things.back().core) corner = corner + by;
  }
  return {{{-8.0, -8.0}, {8.0, 8.0}}, std::move(things)};
}

/// The clearance in a world is that of the widest disk that can be swept.
TEST(Safety, AMiddleKeepsTheRadiusOfTheWidestDiskFromShapes) {
  Rng rng = Rng(11).child("widest");
  int clear = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const CollisionMap world = random_world(rng);
    Plan plan;
    for (int k = 0; k < 3; ++k) plan.waypoints.push_back(testing::random_point(rng, 7.0));
    const double least = clearance_m(plan, world, {});
    const auto fits = [&](double radius_m) {
      return world.segment_free({plan.waypoints[0], plan.waypoints[1]}, radius_m) &&
             world.segment_free({plan.waypoints[1], plan.waypoints[2]}, radius_m);
    };
    if (least < 1e-6) {
      EXPECT_FALSE(fits(1e-5)) << "case " << i;
      continue;
    }
    ++clear;
    EXPECT_TRUE(fits(least - 1e-7)) << "case " << i;
    EXPECT_FALSE(fits(least + 1e-7)) << "case " << i;
    EXPECT_TRUE(check(plan, world, least).has_value());
    EXPECT_FALSE(check(plan, world, least + 1e-6).has_value());
  }
  EXPECT_GT(clear, testing::cases(30));
}

/// A robot on an arc among shapes: by poses that are close together, which see at most what it comes nearer.
TEST(Safety, AnOutlineKeepsFromShapesWhatDensePosesSee) {
  Rng rng = Rng(12).child("poses");
  for (int i = 0; i < testing::cases(60); ++i) {
    const CollisionMap world = random_world(rng);
    const auto outline = testing::random_outline(rng, rng.uniform(0.2, 1.0));
    Plan plan;
    plan.steering = Steering{0.1, true};
    PathPiece arc{
        testing::random_point(rng, 4.0), {}, testing::random_point(rng, 4.0), rng.uniform(-3.0, 3.0)};
    arc.to = arc.centre + rotated(arc.turn_rad, arc.from - arc.centre);
    plan.pieces = {arc};
    plan.waypoints = {arc.from, arc.to};
    double dense = endless, outer = 0.0;
    for (const Vec2 corner : outline) outer = std::max(outer, norm(corner));
    const double radius = distance(arc.from, arc.centre) + outer;
    const int steps = 1 + static_cast<int>(radius * std::abs(arc.turn_rad) / 0.01);
    for (int k = 0; k <= steps; ++k) {
      const double part = static_cast<double>(k) / steps;
      const Pose2 pose{point_on(arc, part), heading_in(arc) + part * arc.turn_rad};
      std::vector<Vec2> placed;
      for (const Vec2 corner : outline) placed.push_back(pose * corner);
      for (std::size_t c = 0; c < placed.size(); ++c) {
        const Segment side{placed[c], placed[(c + 1) % placed.size()]};
        for (const Vec2 at : {side.a, 0.5 * (side.a + side.b)})
          dense = std::min(dense, world.clearance(at, 20.0));
        for (const RoundedPolygon& thing : world.obstacles())
          dense = std::min(dense, signed_distance(side, thing));
      }
      for (const RoundedPolygon& thing : world.obstacles())
        dense = std::min(dense, signed_distance(thing.core.front(), {placed, thing.radius_m}));
    }
    const double least = clearance_m(plan, world, outline);
    if (dense < 0.0 && least < 0.01) continue;  // it overlaps
    const double off = hulls_error_m(plan, outline);
    EXPECT_LE(least, dense + off + 1e-9) << "case " << i;
    EXPECT_GE(least, dense - off - 0.0101) << "case " << i;
  }
}

TEST(Safety, AnOutlineOnAGridKeepsWhatItsCornersAndThoseOfTheCellsSay) {
  Grid<std::uint8_t> grid(GridFrame{{}, 0.5, 20, 20});
  grid[{10, 10}] = 1;  // 5 to 5.5 m
  const GridMap ground = *GridMap::of(grid, GridModel::cells);
  Plan plan;
  plan.steering = Steering{1.0, false};
  plan.pieces = {{{2.0, 4.0}, {8.0, 4.0}, {}, 0.0}};
  plan.waypoints = {{2.0, 4.0}, {8.0, 4.0}};
  EXPECT_NEAR(clearance_m(plan, ground, {}, endless), 1.0, 1e-12);
  EXPECT_NEAR(clearance_m(plan, ground, {{-0.5, -0.4}, {0.5, -0.4}, {0.5, 0.7}, {-0.5, 0.7}}, endless), 0.3,
              1e-12);
  EXPECT_NEAR(clearance_m(plan, ground, {{-0.5, -0.4}, {0.5, -0.4}, {0.0, 1.0}}, endless), 0.0, 1e-12);
  EXPECT_NEAR(clearance_m(plan, ground, {}, 0.2), 0.2, 1e-12);
  // On an arc about (5.25, 2): the side that faces outwards passes the cell below its middle.
  plan.pieces = {{{3.25, 2.0}, {7.25, 2.0}, {5.25, 2.0}, -pi}};
  EXPECT_NEAR(clearance_m(plan, ground, {{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}}, endless),
              3.0 - std::hypot(2.3, 0.3), 1e-9);
}

}  // namespace
}  // namespace outrider
