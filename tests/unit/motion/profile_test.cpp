#include "outrider/motion/profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

/// Time by integrating ds / v(s) over the distance, v(s) being the highest speed from which one can
/// have started and can still stop. The substitution s = D (1 - cos u) / 2 tames the ends.
double integrated_duration(double distance, const Limits& limits) {
  constexpr int steps = 20000;
  double time = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double u = std::acos(-1.0) * (i + 0.5) / steps;
    const double s = 0.5 * distance * (1.0 - std::cos(u));
    const double left = distance - s;
    const double speed = std::min(limits.speed, std::sqrt(2.0 * limits.acceleration * std::min(s, left)));
    time += 0.5 * distance * std::sin(u) * (std::acos(-1.0) / steps) / speed;
  }
  return time;
}

TEST(Profile, DurationAgainstIntegration) {
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const Limits limits{rng.uniform(0.1, 3.0), rng.uniform(0.1, 10.0)};
    const double distance = rng.uniform(0.001, 5.0);
    EXPECT_NEAR(duration(distance, limits), integrated_duration(distance, limits),
                1e-3 * duration(distance, limits));
  }
}

TEST(Profile, KnownCases) {
  EXPECT_DOUBLE_EQ(duration(1.0, {10.0, 1.0}), 2.0);   // never reaches the limit: 2 sqrt(d / a)
  EXPECT_DOUBLE_EQ(duration(10.0, {1.0, 1.0}), 11.0);  // d / v + v / a
  EXPECT_DOUBLE_EQ(duration(0.8, {0.8, 0.8}), 2.0);    // just reaches it
  EXPECT_EQ(duration(0.0, {1.0, 1.0}), 0.0);
  EXPECT_DOUBLE_EQ(duration(3.0, {2.0, std::numeric_limits<double>::infinity()}), 1.5);
}

TEST(Profile, CoveredKeepsTheLimitsAndArrives) {
  Rng rng(2);
  for (int round = 0; round < 50; ++round) {
    const Limits limits{rng.uniform(0.1, 3.0), rng.uniform(0.1, 10.0)};
    const double distance = rng.uniform(0.001, 5.0);
    const double total = duration(distance, limits);
    const double dt = total / 2000;
    double previous_speed = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double speed = (covered(distance, limits, (i + 1) * dt) - covered(distance, limits, i * dt)) / dt;
      EXPECT_GE(speed, -1e-9);
      EXPECT_LE(speed, limits.speed + 1e-9);
      EXPECT_LE(std::abs(speed - previous_speed), limits.acceleration * dt + 1e-9);
      previous_speed = speed;
    }
    EXPECT_DOUBLE_EQ(covered(distance, limits, total), distance);
    EXPECT_NEAR(covered(distance, limits, 0.5 * total), 0.5 * distance, 1e-12);
  }
}

TEST(Profile, CoveredIsClamped) {
  const Limits limits{1.0, 1.0};
  EXPECT_EQ(covered(5.0, limits, -1.0), 0.0);
  EXPECT_EQ(covered(5.0, limits, 0.0), 0.0);
  EXPECT_EQ(covered(5.0, limits, 1e9), 5.0);
  EXPECT_EQ(covered(0.0, limits, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(covered(3.0, {2.0, std::numeric_limits<double>::infinity()}, 0.5), 1.0);
}

}  // namespace
}  // namespace outrider
