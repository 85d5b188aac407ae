#include "outrider/sim/bodies/wheels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

/// Wheels that do not slip, in small steps.
Pose2 rolled(Pose2 pose, const WheelSpeeds& speeds, const WheelBase& base, double period_s) {
  const double left = speeds.left_radps * base.wheel_radius_m;
  const double right = speeds.right_radps * base.wheel_radius_m;
  pose.heading_rad += period_s * (right - left) / (2.0 * base.half_track_m);
  pose.position = pose.position + 0.5 * period_s * (left + right) * direction(pose.heading_rad);
  return pose;
}

TEST(Wheels, RollAsTheReferenceSaysWhereThereIsNoError) {
  const WheelBase base = wheel_base({});
  const Pose2 pose{{1.0, 2.0}, 0.7};
  const WheelSpeeds straight = follow({pose, 0.8, 0.0}, pose, {});
  EXPECT_NEAR(straight.left_radps, 0.8 / base.wheel_radius_m, 1e-9);
  EXPECT_NEAR(straight.right_radps, 0.8 / base.wheel_radius_m, 1e-9);
  const WheelSpeeds turn = follow({pose, 0.0, 0.5}, pose, {});
  EXPECT_NEAR(turn.right_radps, 0.5 * base.half_track_m / base.wheel_radius_m, 1e-9);
  EXPECT_NEAR(turn.left_radps, -turn.right_radps, 1e-9);
}

TEST(Wheels, CatchUpWithALineThatMovesOn) {
  Rng rng(611);
  RobotModel robot;  // faster than the line
  robot.speed_mps = 1.6;
  robot.turn_rate_radps = 4.0;
  const WheelBase base = wheel_base(robot);
  for (int i = 0; i < cases(50); ++i) {
    const double heading = rng.uniform(-pi, pi);
    const Vec2 along = direction(heading);
    Pose2 pose{{rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05)}, heading + rng.uniform(-0.3, 0.3)};
    for (double t = 0.0; t < 4.0; t += 1e-3) {
      pose = rolled(pose, follow({{0.8 * t * along, heading}, 0.8, 0.0}, pose, robot), base, 1e-3);
    }
    EXPECT_LT(distance(pose.position, 3.2 * along), 2e-3);
    EXPECT_NEAR(wrap_angle(pose.heading_rad - heading), 0.0, 1e-3);
  }
}

TEST(Wheels, NeverAskForMoreThanTheRobotsLimits) {
  Rng rng(613);
  for (int i = 0; i < cases(500); ++i) {
    RobotModel robot;
    robot.speed_mps = rng.uniform(0.1, 2.0);
    robot.turn_rate_radps = rng.uniform(0.1, 2.0);
    const Reference reference{{{rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)}, rng.uniform(-pi, pi)},
                              robot.speed_mps,
                              robot.turn_rate_radps};
    const WheelBase base = wheel_base(robot);
    const WheelSpeeds speeds = follow(reference, {}, robot);
    const double left = speeds.left_radps * base.wheel_radius_m;
    const double right = speeds.right_radps * base.wheel_radius_m;
    EXPECT_LE(std::abs(0.5 * (left + right)), robot.speed_mps + 1e-9);
    EXPECT_LE(std::abs(right - left) / (2.0 * base.half_track_m), robot.turn_rate_radps + 1e-9);
  }
}

TEST(Wheels, FitIntoTheRobot) {
  Rng rng(612);
  for (int i = 0; i < cases(100); ++i) {
    RobotModel robot;
    robot.radius_m = rng.uniform(0.05, 1.0);
    robot.height_m = rng.uniform(0.05, 2.0);
    const WheelBase base = wheel_base(robot);
    EXPECT_LT(std::hypot(base.wheel_radius_m, base.half_track_m + 0.15 * base.wheel_radius_m),
              0.9 * robot.radius_m);
    EXPECT_LT(2.0 * base.wheel_radius_m, robot.height_m);
  }
}

}  // namespace
}  // namespace outrider
