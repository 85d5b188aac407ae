#include "outrider/control/pid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

TEST(Pid, AddsItsThreeParts) {
  Pid pid;
  const PidGains gains{2.0, 0.5, 0.1};
  EXPECT_NEAR(step(pid, gains, {1.0, 0.0}, {100.0, 0.0}, 0.1).x, 2.0 * 1.0 + 0.5 * 0.1, 1e-12);
  const double second = step(pid, gains, {0.8, 0.0}, {100.0, 0.0}, 0.1).x;
  EXPECT_NEAR(second, 2.0 * 0.8 + 0.5 * (0.1 + 0.08) + 0.1 * (-0.2 / 0.1), 1e-12);
}

TEST(Pid, ACutCommandKeepsItsDirection) {
  Pid pid;
  const Vec2 command = step(pid, {1.0, 0.0, 0.0}, {3.0, 4.0}, {0.5, 0.0}, 0.1);
  EXPECT_NEAR(norm(command), 0.5, 1e-12);
  EXPECT_NEAR(cross(command, {3.0, 4.0}), 0.0, 1e-12);
}

TEST(Pid, AShortCommandIsRaisedToTheFloor) {
  Pid pid;
  EXPECT_NEAR(step(pid, {1.0, 0.0, 0.0}, {-0.001, 0.0}, {0.5, 0.02}, 0.1).x, -0.02, 1e-12);
  Pid none;
  EXPECT_EQ(step(none, {1.0, 0.0, 0.0}, {}, {0.5, 0.02}, 0.1), Vec2{});
}

/// Goes to 1 from 0 at a speed that is cut; returns how far beyond it gets.
double overshoot(bool windup) {
  Pid pid;
  const PidGains gains{0.5, 0.2, 0.0};
  double at = 0.0, integral = 0.0, farthest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double error = 1.0 - at;
    integral += 0.05 * error;
    const double wound = std::clamp(0.5 * error + 0.2 * integral, -0.1, 0.1);
    at += 0.05 * (windup ? wound : step(pid, gains, {error, 0.0}, {0.1, 0.0}, 0.05).x);
    farthest = std::max(farthest, at - 1.0);
  }
  return farthest;
}

TEST(Pid, DoesNotWindUp) {
  EXPECT_GT(overshoot(true), 0.5);
  EXPECT_LT(overshoot(false), 0.01);
}

TEST(Pid, TheIntegralWorksAgainstASteadyError) {
  double mean[2] = {};
  for (const int with : {0, 1}) {
    Pid pid;
    double at = 0.0;
    for (int i = 0; i < 8000; ++i) {
      at += 0.05 * (step(pid, {1.0, 0.3 * with, 0.0}, {1.0 - at, 0.0}, {1.0, 0.0}, 0.05).x - 0.1);
      if (i >= 4000) mean[with] += std::abs(1.0 - at) / 4000.0;
    }
  }
  EXPECT_NEAR(mean[0], 0.1, 1e-3);
  EXPECT_LT(mean[1], 0.6 * mean[0]);
}

}  // namespace
}  // namespace outrider
