#include "outrider/jobs/drive/localisation/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

Chassis chassis() { return mecanum_chassis(0.03, 0.1225); }

Reckoning at_rest() {
  Reckoning reckoning;
  reckoning.belief.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  return reckoning;
}

TEST(DeadReckoning, CommandsTakeEffectAfterTheirDelay) {
  const ReckoningOptions options{.delay_s = 0.1, .lag_s = 0.0};
  Reckoning reckoning = at_rest();
  reckoning.sent = {{0.0, {0.5, 0.0, 0.0}}, {1.0, {}}};
  advance(reckoning, 0.1, options, chassis());
  EXPECT_EQ(reckoning.belief.world_T_robot.position.x, 0.0);
  advance(reckoning, 0.6, options, chassis());
  EXPECT_NEAR(reckoning.belief.world_T_robot.position.x, 0.25, 1e-12);
  advance(reckoning, 3.0, options, chassis());
  EXPECT_NEAR(reckoning.belief.world_T_robot.position.x, 0.5, 1e-12);
  EXPECT_TRUE(reckoning.sent.empty());
}

TEST(DeadReckoning, TheLagAgainstManySmallSteps) {
  const ReckoningOptions options{.delay_s = 0.0, .lag_s = 0.2};
  Reckoning reckoning = at_rest();
  reckoning.sent = {{0.0, {0.4, 0.1, 0.0}}};
  for (int i = 1; i <= 20; ++i) advance(reckoning, 0.05 * i, options, chassis());
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
  advance(reckoning, 100.0, options, chassis());
  EXPECT_EQ(position_sigma_m(reckoning.belief), 0.01);
  reckoning.sent = {{100.0, {0.3, 0.0, 0.0}}};
  double before = 0.0;
  for (int i = 1; i <= 400; ++i) {
    advance(reckoning, 100.0 + 0.05 * i, options, chassis());
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
  for (int i = 1; i <= 40; ++i) advance(reckoning, 0.05 * i, options, chassis());
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

/// Drives a robot with those errors about, and corrects the belief by poses with normal errors ten times a
/// second. Returns the largest Mahalanobis distance of the position.
double drive_about(Reckoning& reckoning, const MotionErrorVector& truth, double duration_s, Rng& rng) {
  const ReckoningOptions options{.delay_s = 0.0, .lag_s = 0.0};
  constexpr double period_s = 0.1, sigma = 0.005;
  Pose2 pose;
  double worst = 0.0;
  for (int i = 0; i * period_s < duration_s; ++i) {
    const Twist2 twist{0.25 * std::sin(0.7 * i * period_s), 0.25 * std::cos(0.5 * i * period_s),
                       0.5 * std::sin(0.3 * i * period_s)};
    reckoning.sent = {{i * period_s, twist}};
    pose = moved(pose, executed(chassis(), truth, twist), period_s);
    advance(reckoning, (i + 1) * period_s, options, chassis());
    PoseBelief measured{pose, sigma * sigma * Eigen::Matrix3d::Identity()};
    measured.world_T_robot.position = pose.position + sigma * Vec2{rng.normal(), rng.normal()};
    measured.world_T_robot.heading_rad += sigma * rng.normal();
    correct(reckoning, measured);
    const Vec2 off = reckoning.belief.world_T_robot.position - pose.position;
    worst = std::max(worst, norm(off) / position_sigma_m(reckoning.belief));
  }
  return worst;
}

TEST(DeadReckoning, LearnsTheErrorsOfTheWheelsAndTheSlip) {
  for (int seed = 1; seed <= testing::cases(5); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    MotionErrorVector truth;
    truth << 0.1, -0.05, 0.0, 0.03, 0.5;
    const ReckoningOptions options;
    Reckoning reckoning = at_rest();
    reckoning.errors = unknown_errors(chassis(), options.wheel_sigma, options.slip_sigma);
    EXPECT_LT(drive_about(reckoning, truth, 60.0, rng), 5.0);
    for (Eigen::Index i = 0; i < motion_error_count; ++i) {
      const double sigma = std::sqrt(reckoning.errors.covariance(i, i));
      EXPECT_NEAR(reckoning.errors.mean[i], truth[i], 4.0 * sigma) << i;
      EXPECT_LT(sigma, 0.08) << i << ": it has learned something";
    }
  }
}

TEST(DeadReckoning, LargeInnovationsIncreaseTheCovariance) {
  Reckoning right = at_rest(), wrong = at_rest();
  for (int i = 0; i < 20; ++i) {
    const PoseBelief here{{}, 1e-4 * Eigen::Matrix3d::Identity()};
    const PoseBelief there{{{i % 2 == 0 ? 0.06 : -0.06, 0.0}, 0.0}, 1e-4 * Eigen::Matrix3d::Identity()};
    correct(right, here);
    correct(wrong, there);
  }
  EXPECT_LT(right.innovation_ratio, 1.0);
  EXPECT_GT(wrong.innovation_ratio, 2.0);
  EXPECT_LT(position_sigma_m(right.belief), 0.003);
  EXPECT_GT(position_sigma_m(wrong.belief), 2.0 * position_sigma_m(right.belief));
}

/// The derivative against differences.
TEST(MotionErrors, TheDerivativeAgainstDifferences) {
  MotionErrorVector errors;
  errors << 0.1, -0.05, 0.02, 0.03, 0.4;
  const Twist2 twist{0.3, -0.2, 0.5};
  for (const Chassis& wheels : {chassis(), holonomic_chassis(0.03, 0.15), differential_chassis(0.03, 0.1)}) {
    const MotionErrorRows rows = executed_by_errors(wheels, errors, twist);
    for (Eigen::Index i = 0; i < motion_error_count; ++i) {
      constexpr double step = 1e-6;
      MotionErrorVector more = errors, less = errors;
      more[i] += step;
      less[i] -= step;
      const Twist2 change =
          (0.5 / step) * (executed(wheels, more, twist) + -1.0 * executed(wheels, less, twist));
      EXPECT_NEAR(rows(0, i), change.ahead_mps, 1e-8);
      EXPECT_NEAR(rows(1, i), change.left_mps, 1e-8);
      EXPECT_NEAR(rows(2, i), change.turn_radps, 1e-8);
    }
  }
  EXPECT_EQ(
      unknown_errors(differential_chassis(0.03, 0.1), 0.04, 0.15).covariance.diagonal().tail<3>().norm(),
      0.0);
}

}  // namespace
}  // namespace outrider
