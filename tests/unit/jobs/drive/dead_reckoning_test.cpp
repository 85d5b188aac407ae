#include "outrider/jobs/drive/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

Reckoning at_rest() {
  Reckoning reckoning;
  reckoning.belief.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  return reckoning;
}

TEST(DeadReckoning, CommandsTakeEffectAfterTheirDelay) {
  const ReckoningOptions options{.delay_s = 0.1, .lag_s = 0.0};
  Reckoning reckoning = at_rest();
  reckoning.sent = {{0.0, {0.5, 0.0, 0.0}}, {1.0, {}}};
  advance(reckoning, 0.1, options);
  EXPECT_EQ(reckoning.belief.world_T_robot.position.x, 0.0);
  advance(reckoning, 0.6, options);
  EXPECT_NEAR(reckoning.belief.world_T_robot.position.x, 0.25, 1e-12);
  advance(reckoning, 3.0, options);
  EXPECT_NEAR(reckoning.belief.world_T_robot.position.x, 0.5, 1e-12);
  EXPECT_TRUE(reckoning.sent.empty());
}

TEST(DeadReckoning, TheLagAgainstManySmallSteps) {
  const ReckoningOptions options{.delay_s = 0.0, .lag_s = 0.2};
  Reckoning reckoning = at_rest();
  reckoning.sent = {{0.0, {0.4, 0.1, 0.0}}};
  for (int i = 1; i <= 20; ++i) advance(reckoning, 0.05 * i, options);
  double speed = 0.0, x = 0.0;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    speed += (0.4 - speed) / 0.2 / steps;
    x += speed / steps;
  }
  EXPECT_NEAR(reckoning.twist.ahead_mps, speed, 1e-5);
  EXPECT_NEAR(reckoning.belief.world_T_robot.position.x, x, 1e-5);
  EXPECT_NEAR(reckoning.belief.world_T_robot.position.y, 0.25 * x, 1e-5);
}

TEST(DeadReckoning, CovarianceGrowsWithTheWayOnly) {
  const ReckoningOptions options;
  Reckoning reckoning = at_rest();
  advance(reckoning, 100.0, options);
  EXPECT_EQ(position_sigma_m(reckoning.belief), 0.01);
  reckoning.sent = {{100.0, {0.3, 0.0, 0.0}}};
  double before = 0.0;
  for (int i = 1; i <= 400; ++i) {
    advance(reckoning, 100.0 + 0.05 * i, options);
    if (i % 20 == 0) {
      EXPECT_GT(position_sigma_m(reckoning.belief), before);
      before = position_sigma_m(reckoning.belief);
    }
  }
  EXPECT_TRUE(is_lost(reckoning.belief, options));
}

/// The covariance against a cloud of robots whose headings and places are drawn from it.
TEST(DeadReckoning, CarriesTheCovarianceAlong) {
  ReckoningOptions options{.delay_s = 0.0, .lag_s = 0.0, .drift = 0.0, .drift_radpm = 0.0};
  Reckoning reckoning = at_rest();
  const Twist2 twist{0.5, -0.2, 0.6};
  reckoning.sent = {{0.0, twist}};
  for (int i = 1; i <= 40; ++i) advance(reckoning, 0.05 * i, options);
  Rng rng(1);
  const int count = testing::cases(20000);
  const Pose2& mean = reckoning.belief.world_T_robot;
  double p[3][3] = {};
  for (int k = 0; k < count; ++k) {
    const Pose2 start{0.01 * Vec2{rng.normal(), rng.normal()}, 0.01 * rng.normal()};
    const Pose2 end = moved(start, twist, 2.0);
    const double off[3] = {end.position.x - mean.position.x, end.position.y - mean.position.y,
                           wrap_angle(end.heading_rad - mean.heading_rad)};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) p[i][j] += off[i] * off[j] / count;
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(reckoning.belief.covariance(i, j), p[i][j], 1e-5);
  }
}

}  // namespace
}  // namespace outrider
