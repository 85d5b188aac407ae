#include "outrider/jobs/drive/localisation/reckoning_history.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

/// Corrections that come late, by the history, against the same corrections in time.
TEST(ReckoningHistory, LateCorrectionsLeadToTheBeliefOfTimelyOnes) {
  const Chassis chassis = mecanum_chassis(0.03, 0.1225);
  const ReckoningOptions options;
  constexpr double period_s = 0.05, latency_s = 0.2;
  constexpr int steps = 60, late_steps = 4;
  Reckoning timely, late;
  timely.belief.covariance = late.belief.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  timely.errors = late.errors = unknown_errors(chassis, 0.03, 0.15);
  ReckoningHistory history;
  const auto measured = [](int step) {
    Rng rng(static_cast<std::uint64_t>(step));
    return PoseBelief{{{0.01 * step + 0.005 * rng.normal(), 0.005 * rng.normal()}, 0.005 * rng.normal()},
                      2.5e-5 * Eigen::Matrix3d::Identity()};
  };
  const auto command = [](int step) { return Twist2{0.2, step < 30 ? 0.1 : -0.1, 0.3}; };
  for (int i = 1; i <= steps + late_steps; ++i) {
    const double now_s = period_s * i;
    advance(timely, now_s, options, chassis);
    if (i % 2 == 0 && i <= steps) correct(timely, measured(i));
    const int taken = i - late_steps;
    if (taken > 0 && taken % 2 == 0) {
      std::vector<double> repeated_s;
      auto then = history.rewind(period_s * taken, repeated_s);
      ASSERT_TRUE(then);
      late = std::move(*then);
      correct(late, measured(taken));
      history.states.push_back(late);
      for (const double time_s : repeated_s) {
        advance(late, time_s, options, chassis);
        history.states.push_back(late);
      }
    }
    advance(late, now_s, options, chassis);
    history.add(late, latency_s + period_s);
    timely.sent.push_back({now_s, command(i)});
    late.sent.push_back({now_s, command(i)});
    history.commands.push_back(late.sent.back());
  }
  EXPECT_LT(history.states.size(), 10U) << "old ones are forgotten";
  EXPECT_NEAR(distance(late.belief.world_T_robot.position, timely.belief.world_T_robot.position), 0.0, 1e-9);
  EXPECT_NEAR(late.belief.world_T_robot.heading_rad, timely.belief.world_T_robot.heading_rad, 1e-9);
  EXPECT_LT((late.belief.covariance - timely.belief.covariance).norm(), 1e-9);
  EXPECT_LT((late.errors.mean - timely.errors.mean).norm(), 1e-9);
}

TEST(ReckoningHistory, WhatIsTooOldIsRefused) {
  ReckoningHistory history;
  std::vector<double> removed_s;
  EXPECT_FALSE(history.rewind(0.0, removed_s));
  Reckoning state;
  state.time_s = 1.0;
  history.add(state, 0.5);
  EXPECT_FALSE(history.rewind(0.9, removed_s));
  EXPECT_TRUE(history.rewind(1.0, removed_s));
}

}  // namespace
}  // namespace outrider
