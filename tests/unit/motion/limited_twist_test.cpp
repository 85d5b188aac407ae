#include "outrider/motion/limited_twist.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

RobotModel car(double radius_m) {
  RobotModel robot;
  robot.turning_radius_m = radius_m;
  return robot;
}

TEST(LimitedTwist, ACarNeverTurnsTighterThanItsRadius) {
  for (const double radius_m : {0.3, 0.8, 5.0}) {
    const RobotModel robot = car(radius_m);
    Rng rng(3);
    Twist2 twist;
    for (int i = 0; i < 20'000; ++i) {
      const Twist2 commanded{rng.uniform(-1.5, 1.5), 0.0, rng.uniform(-2.0, 2.0)};
      const double step_s = rng.uniform(0.001, 0.1);
      const Twist2 next =
          twist_after(twist, rng.uniform(0.0, 1.0) < 0.2 ? Twist2{} : commanded, robot, step_s);
      EXPECT_LE(std::abs(next.turn_radps), std::abs(next.ahead_mps) / radius_m + 1e-12);
      EXPECT_LE(std::abs(next.ahead_mps - twist.ahead_mps), robot.acceleration_mps2 * step_s + 1e-12);
      EXPECT_LE(std::abs(next.turn_radps), robot.turn_rate_radps + 1e-12);
      twist = next;
    }
  }
}

TEST(LimitedTwist, ACarBrakesAlongItsCurve) {
  const RobotModel robot = car(0.5);
  Twist2 twist{0.8, 0.0, 0.6};
  while (twist.ahead_mps > 0.01) {
    twist = twist_after(twist, {}, robot, 0.005);
    EXPECT_NEAR(twist.turn_radps / twist.ahead_mps, 0.75, 1e-9);
  }
  EXPECT_EQ(twist_after(twist, {}, robot, 0.1), (Twist2{}));
}

TEST(LimitedTwist, ACarDoesNotTurnInPlaceAndOthersDo) {
  EXPECT_EQ(twist_after({}, {0.0, 0.0, 0.5}, car(0.5), 1.0), (Twist2{}));
  EXPECT_EQ(twist_after({}, {0.0, 0.0, 0.5}, RobotModel{}, 1.0), (Twist2{0.0, 0.0, 0.5}));
}

}  // namespace
}  // namespace outrider
