#include "outrider/motion/twist.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

Twist2 random_twist(Rng& rng) {
  return {rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.below(4) == 0 ? 0.0 : rng.uniform(-2.0, 2.0)};
}

void expect_same(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.position.x, b.position.x, tolerance);
  EXPECT_NEAR(a.position.y, b.position.y, tolerance);
  EXPECT_NEAR(a.heading_rad, b.heading_rad, tolerance);
}

TEST(Twist, MovedAgainstManySmallSteps) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(50); ++round) {
    const Twist2 twist = random_twist(rng);
    const Pose2 start{testing::random_point(rng, 3.0), rng.uniform(-pi, pi)};
    constexpr int steps = 20000;
    const double time_s = rng.uniform(0.1, 2.0), dt = time_s / steps;
    Pose2 at = start;
    for (int i = 0; i < steps; ++i) {  // the midpoint rule
      const double middle = at.heading_rad + 0.5 * dt * twist.turn_radps;
      const Vec2 ahead = direction(middle);
      at.position = at.position + dt * (twist.ahead_mps * ahead + twist.left_mps * perpendicular(ahead));
      at.heading_rad += dt * twist.turn_radps;
    }
    expect_same(moved(start, twist, time_s), at, 1e-8);
  }
}

TEST(Twist, TheLogarithmUndoesIt) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(500); ++round) {
    const Twist2 twist = random_twist(rng);
    const Pose2 start{testing::random_point(rng, 3.0), rng.uniform(-pi, pi)};
    const double time_s = rng.uniform(0.1, 2.5);
    const Twist2 found = twist_between(start, moved(start, twist, time_s), time_s);
    EXPECT_NEAR(found.ahead_mps, twist.ahead_mps, 1e-9);
    EXPECT_NEAR(found.left_mps, twist.left_mps, 1e-9);
    EXPECT_NEAR(found.turn_radps, twist.turn_radps, 1e-9);
  }
}

TEST(Twist, TinyTurnsLoseNoDigits) {
  for (const double turn : {0.0, 1e-12, 1e-5, 0.99e-4, 1.01e-4}) {
    const Pose2 end = moved({}, {1.0, 0.0, turn}, 1.0);
    EXPECT_NEAR(end.position.x, 1.0 - turn * turn / 6.0, 1e-15);
    EXPECT_NEAR(end.position.y, turn / 2.0, 1e-12);
  }
}

}  // namespace
}  // namespace outrider
