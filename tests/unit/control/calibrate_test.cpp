#include "outrider/control/calibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr Twist2 commands[] = {{0.2, 0, 0},  {-0.2, 0, 0}, {0, 0.2, 0},
                               {0, -0.2, 0}, {0, 0, 0.5},  {0, 0, -0.5}};

/// A robot with its faults, told apart from what calibrate() assumes only by how it is simulated: wheel by
/// wheel, then direction by direction.
struct FaultyRobot {
  Chassis chassis = mecanum_chassis(0.03, 0.1225);
  Calibration truth;

  [[nodiscard]] Twist2 answer(const WheelSpeeds4& commanded) const {
    WheelSpeeds4 turned = commanded;
    for (std::size_t i = 0; i < chassis.wheels.size(); ++i) turned[i] *= truth.wheels[i];
    Twist2 body = twist_of(chassis, turned);
    body.ahead_mps *= ahead_law(truth, body.ahead_mps).gain;
    body.left_mps *= left_law(truth, body.left_mps).gain;
    body.turn_radps *= turn_law(truth, body.turn_radps).gain;
    return body;
  }

  [[nodiscard]] std::vector<CalibrationRun> runs(Rng& rng, double noise) const {
    std::vector<CalibrationRun> all;
    for (const Twist2& command : commands) {
      if (command.left_mps != 0.0 && !chassis.moves_sideways()) continue;
      for (const double time_s : {1.0, 2.0, 3.0, 4.0}) {
        const DirectionLaw& law = command.ahead_mps != 0.0  ? ahead_law(truth, command.ahead_mps)
                                  : command.left_mps != 0.0 ? left_law(truth, command.left_mps)
                                                            : turn_law(truth, command.turn_radps);
        Pose2 end = moved({}, answer(wheel_speeds(chassis, command)), time_s - law.dead_time_s);
        end.position = end.position + noise * Vec2{rng.normal(), rng.normal()};
        end.heading_rad += noise * rng.normal();
        all.push_back({command, time_s, end, "runs.csv:2"});
      }
    }
    return all;
  }
};

FaultyRobot random_robot(Rng& rng, double spread) {
  FaultyRobot robot;
  double mean = 0.0;
  for (double& gain : robot.truth.wheels) mean += 0.25 * (gain = 1.0 + spread * rng.uniform(-1.0, 1.0));
  for (double& gain : robot.truth.wheels) gain += 1.0 - mean;
  for (DirectionLaw& law : robot.truth.laws) law = {rng.uniform(0.8, 1.2), rng.uniform(0.0, 0.3)};
  return robot;
}

TEST(Calibrate, FindsTheRobotThatMadeTheRuns) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(20); ++round) {
    const FaultyRobot robot = random_robot(rng, 0.01);
    const auto fit = calibrate(robot.chassis, robot.runs(rng, 0.0));
    ASSERT_TRUE(fit);
    ASSERT_EQ(fit->laws.size(), 6U);
    for (std::size_t d = 0; d < directions; ++d) {
      EXPECT_NEAR(fit->calibration.laws[d].gain, robot.truth.laws[d].gain, 1e-3);
      EXPECT_NEAR(fit->calibration.laws[d].dead_time_s, robot.truth.laws[d].dead_time_s, 1e-3);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(fit->calibration.wheels[i], robot.truth.wheels[i], 1e-3);
    }
  }
}

TEST(Calibrate, CommandsMakeUpForTheFaults) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(50); ++round) {
    FaultyRobot robot = random_robot(rng, 0.02);
    const Twist2 wanted{rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), rng.uniform(-1.0, 1.0)};
    const Twist2 got = robot.answer(commanded_wheels(robot.chassis, robot.truth, wanted));
    EXPECT_NEAR(got.ahead_mps, wanted.ahead_mps, 1e-9);
    EXPECT_NEAR(got.left_mps, wanted.left_mps, 1e-9);
    EXPECT_NEAR(got.turn_radps, wanted.turn_radps, 1e-9);
  }
}

/// 95 % intervals hold the truth in 95 % of the cases.
TEST(Calibrate, IntervalsHoldWhatTheyPromise) {
  Rng rng(3);
  FaultyRobot robot;
  robot.truth.wheels = {1.01, 0.99, 0.995, 1.005};
  for (DirectionLaw& law : robot.truth.laws) law = {0.95, 0.1};
  int laws = 0, wheels = 0;
  const int rounds = testing::cases(300);
  for (int round = 0; round < rounds; ++round) {
    const auto fit = calibrate(robot.chassis, robot.runs(rng, 0.003));
    ASSERT_TRUE(fit);
    const FittedLaw& ahead = fit->laws.front();
    laws += std::abs(ahead.slope.value - 0.95 * 0.2) <= ahead.slope.half_width ? 1 : 0;
    wheels += std::abs(fit->wheels[0].value - 1.01) <= fit->wheels[0].half_width ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(laws) / rounds, 0.95, 0.04);
  EXPECT_GT(static_cast<double>(wheels) / rounds, 0.85);
}

TEST(Calibrate, WhatNoRunShowsIsNotClaimed) {
  Rng rng(4);
  FaultyRobot robot;
  robot.truth.wheels = {1.01, 0.99, 1.0, 1.0};
  auto runs = robot.runs(rng, 0.001);
  std::erase_if(runs, [](const CalibrationRun& run) { return run.command.ahead_mps == 0.0; });
  const auto fit = calibrate(robot.chassis, runs);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(std::isinf(fit->wheels[0].half_width));
  EXPECT_EQ(fit->laws.size(), 2U);
  EXPECT_EQ(fit->calibration.laws[2].gain, 1.0);
  FaultyRobot two{differential_chassis(0.03, 0.1), {}};
  two.truth.wheels = {0.98, 1.02, 1.0, 1.0};
  const auto straight = calibrate(two.chassis, two.runs(rng, 0.0));
  ASSERT_TRUE(straight);
  EXPECT_NEAR(straight->wheels[0].value, 0.98, 1e-3);
}

TEST(Calibrate, StudentQuantilesAgainstIntegration) {
  for (const std::size_t n : {1U, 2U, 3U, 5U, 10U, 40U}) {
    const double t = student_quantile(n);
    // The density without its constant; the substitution x = tan(u) brings infinity near.
    const auto mass = [&](double from, double to) {
      constexpr int steps = 20000;
      double sum = 0.0;
      for (int i = 0; i < steps; ++i) {
        const double u = from + (to - from) * (i + 0.5) / steps;
        const double x = std::tan(u);
        sum += std::pow(1.0 + x * x / static_cast<double>(n), -0.5 * (static_cast<double>(n) + 1.0)) *
               (1.0 + x * x) * (to - from) / steps;
      }
      return sum;
    };
    const double tail = mass(std::atan(t), 0.5 * pi) / (2.0 * mass(0.0, 0.5 * pi));
    EXPECT_NEAR(tail, 0.025, 2e-4) << n;
  }
}

TEST(Calibrate, RefusesRunsThatSayNothing) {
  Rng rng(5);
  const FaultyRobot robot;
  const auto refused = [&](const auto& change, const std::string& says) {
    auto runs = robot.runs(rng, 0.0);
    change(runs);
    const auto fit = calibrate(robot.chassis, runs);
    ASSERT_FALSE(fit) << says;
    EXPECT_EQ(fit.error().code, FaultCode::bad_input);
    EXPECT_NE(to_string(fit.error()).find(says), std::string::npos) << to_string(fit.error());
  };
  refused([](auto& runs) { runs.clear(); }, "no runs");
  refused([](auto& runs) { runs[3].command.turn_radps = 0.1; }, "runs.csv:2: the run is commanded in 2");
  refused([](auto& runs) { runs[3].command = {}; }, "in 0 directions");
  refused([](auto& runs) { runs[3].time_s = 0.0; }, "more than 0 s");
  refused([](auto& runs) { runs.erase(runs.begin() + 2, runs.begin() + 4); }, "at least 3");
  refused(
      [](auto& runs) {
        for (auto& run : runs) run.time_s = 2.0;
      },
      "all of one time");
  refused(
      [](auto& runs) {
        for (auto& run : runs) run.start_T_end.position.x *= -1.0;
      },
      "signs");
  refused([](auto& runs) { runs[0].start_T_end.heading_rad = 6.0; }, "less than 300");
  auto runs = robot.runs(rng, 0.0);
  EXPECT_FALSE(calibrate(differential_chassis(0.03, 0.1), runs));
}

}  // namespace
}  // namespace outrider
