#include "outrider/path/timing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/motion/robot_model.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr DriveLimits limits{0.8, 0.8, 0.8, 0.4, 0.8, 6.0};

Plan plan_through(std::vector<Vec2> waypoints) {
  Plan plan;
  plan.waypoints = std::move(waypoints);
  return plan;
}

double time_of(const Plan& plan) {
  const auto drive = fastest_drive(plan, limits);
  EXPECT_TRUE(drive.has_value());
  return drive ? drive->time_s : -1.0;
}

TEST(Timing, OfLegsIsThatOfARobotThatTurnsInPlace) {
  Rng rng(1);
  const RobotModel robot;
  for (int round = 0; round < testing::cases(100); ++round) {
    std::vector<Vec2> waypoints;
    for (std::uint64_t i = 2 + rng.below(6); i > 0; --i) waypoints.push_back(testing::random_point(rng, 3.0));
    const DriveCost cost = drive_cost(robot, heading_of(waypoints[1] - waypoints[0]), waypoints);
    const auto drive = fastest_drive(plan_through(waypoints), limits);
    ASSERT_TRUE(drive.has_value());
    EXPECT_NEAR(drive->time_s, cost.time_s, 1e-9);
    EXPECT_NEAR(drive->driven_m, cost.driven_m, 1e-9);
    EXPECT_NEAR(drive->turned_rad, cost.turned_rad, 1e-9);
  }
}

TEST(Timing, WaypointsOnALineAndTwiceAreNoStops) {
  const double time_s = time_of(plan_through({{0, 0}, {3, 4}}));
  EXPECT_NEAR(time_of(plan_through({{0, 0}, {0.3, 0.4}, {0.3, 0.4}, {1.5, 2}, {3, 4}})), time_s, 1e-12);
  EXPECT_EQ(time_of(plan_through({{1, 1}})), 0.0);
  EXPECT_EQ(time_of(plan_through({{1, 1}, {1, 1}})), 0.0);
  EXPECT_EQ(time_of(Plan{}), 0.0);
}

/// A leg, a quarter of a ring that touches it, and a leg.
std::vector<PathPiece> round_a_corner(double radius_m) {
  const Vec2 corner{2.0, radius_m};
  return {{{0, 0}, {2, 0}, {}, 0.0},
          {{2, 0}, corner + Vec2{radius_m, 0}, corner, 0.5 * pi},
          {corner + Vec2{radius_m, 0}, corner + Vec2{radius_m, 2}, {}, 0.0}};
}

TEST(Timing, RollsOnThroughAnArc) {
  Plan plan;
  plan.pieces = round_a_corner(1.0);
  // 0.632 m/s by the lateral acceleration: a leg reaches 0.8 m/s and falls to that, the arc keeps it.
  const double bend_mps = std::sqrt(0.4), up_m = 0.4, fall_m = (0.64 - 0.4) / 1.6;
  const double leg_s = 1.0 + (0.8 - bend_mps) / 0.8 + (2.0 - up_m - fall_m) / 0.8;
  EXPECT_NEAR(time_of(plan), 2.0 * leg_s + 0.5 * pi / bend_mps, 1e-12);
  EXPECT_EQ(fastest_drive(plan, limits)->turned_rad, 0.0);
  plan.pieces = round_a_corner(0.1);  // 0.08 m/s by the turn rate
  const double slow_m = (0.64 - 0.0064) / 1.6;
  EXPECT_NEAR(time_of(plan), 2.0 * (1.0 + 0.72 / 0.8 + (2.0 - 0.4 - slow_m) / 0.8) + 0.5 * pi / 0.8, 1e-12);
}

TEST(Timing, AnArcWithoutRadiusIsACorner) {
  Plan plan;
  plan.pieces = round_a_corner(0.0);
  EXPECT_NEAR(time_of(plan), time_of(plan_through({{0, 0}, {2, 0}, {2, 2}})), 1e-12);
  EXPECT_NEAR(fastest_drive(plan, limits)->turned_rad, 0.5 * pi, 1e-12);
}

TEST(Timing, ARobotThatSteersRestsAtCuspsOnly) {
  Plan plan;
  plan.steering = Steering{1.0, true};
  plan.pieces = {{{0, 0}, {2, 0}, {}, 0.0}, {{2, 0}, {1, 0}, {}, 0.0, true}};
  EXPECT_NEAR(time_of(plan), duration(2.0, {0.8, 0.8}) + duration(1.0, {0.8, 0.8}), 1e-12);
  EXPECT_EQ(fastest_drive(plan, limits)->turned_rad, 0.0);
  plan.steering.reset();  // a robot that turns in place turns round
  plan.pieces[1].backward = false;
  EXPECT_NEAR(fastest_drive(plan, limits)->turned_rad, pi, 1e-12);
}

TEST(Timing, RefusesLimits) {
  DriveLimits none;
  none.speed_mps = 0.0;
  EXPECT_FALSE(fastest_drive(plan_through({{0, 0}, {1, 0}}), none).has_value());
}

}  // namespace
}  // namespace outrider
