#include "outrider/control/calibrate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

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

/// 25 runs of each direction, each with its own line.
std::vector<CalibrationRun> many_runs(const FaultyRobot& robot, Rng& rng) {
  std::vector<CalibrationRun> all;
  for (int i = 0; i < 7; ++i) {
    for (CalibrationRun& run : robot.runs(rng, 0.003)) all.push_back(std::move(run));
  }
  std::map<std::size_t, int> count;  // of each direction
  std::vector<CalibrationRun> kept;
  for (CalibrationRun& run : all) {
    const auto of = std::ranges::find(commands, run.command) - commands;
    if (++count[static_cast<std::size_t>(of)] > 25) continue;
    run.where = "runs.csv:" + std::to_string(kept.size() + 2);
    kept.push_back(std::move(run));
  }
  return kept;
}

/// Spoils a number as a hand does: a point, a sign or a digit in the wrong place, or the number of another
/// run.
void mistype(CalibrationRun& run, int kind) {
  Pose2& end = run.start_T_end;
  const bool turns = run.command.turn_radps != 0.0;
  double& main = turns ? end.heading_rad : run.command.ahead_mps != 0.0 ? end.position.x : end.position.y;
  switch (kind % 6) {
    case 0: main *= 0.1; return;
    case 1: main = -main; return;
    case 2: main *= 1.2; return;
    case 3: run.time_s += 1.0; return;
    case 4: (turns ? end.position.x : end.heading_rad) += 0.3; return;
    default: (run.command.left_mps != 0.0 ? end.position.x : end.position.y) += 0.2;
  }
}

/// The fit is that of the file without the run, whose line is named.
TEST(Calibrate, NamesEachMistypedRunAndLeavesItOut) {
  Rng rng(6);
  FaultyRobot robot = random_robot(rng, 0.01);
  const std::vector<CalibrationRun> runs = many_runs(robot, rng);
  ASSERT_EQ(runs.size(), 150U);
  const auto clean = calibrate(robot.chassis, runs);
  ASSERT_TRUE(clean);
  EXPECT_TRUE(clean->left_out.empty());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (int kind = 0; kind < 6; ++kind) {
      auto mistyped = runs, without = runs;
      mistype(mistyped[i], kind);
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
      const auto fit = calibrate(robot.chassis, mistyped);
      ASSERT_TRUE(fit) << i << ' ' << kind << ": " << to_string(fit.error());
      ASSERT_EQ(fit->left_out.size(), 1U) << i << ' ' << kind;
      EXPECT_EQ(fit->left_out[0].where, runs[i].where);
      const auto expected = calibrate(robot.chassis, without);
      ASSERT_TRUE(expected);
      for (std::size_t d = 0; d < directions; ++d) {
        EXPECT_EQ(fit->calibration.laws[d].gain, expected->calibration.laws[d].gain);
        EXPECT_NEAR(fit->calibration.laws[d].gain, clean->calibration.laws[d].gain, 0.005);
      }
      for (std::size_t w = 0; w < 4; ++w)
        EXPECT_EQ(fit->calibration.wheels[w], expected->calibration.wheels[w]);
    }
  }
}

TEST(Calibrate, NamesSeveralMistypedRuns) {
  Rng rng(7);
  for (int round = 0; round < testing::cases(20); ++round) {
    FaultyRobot robot = random_robot(rng, 0.01);
    auto runs = many_runs(robot, rng);
    std::set<std::string> mistyped;
    for (int i = 0; i < 5; ++i) {
      CalibrationRun& run = runs[rng.below(runs.size())];
      if (mistyped.insert(run.where).second) mistype(run, static_cast<int>(rng.below(6)));
    }
    const auto fit = calibrate(robot.chassis, runs);
    ASSERT_TRUE(fit);
    std::set<std::string> named;
    for (const LeftOutRun& run : fit->left_out) named.insert(run.where);
    EXPECT_EQ(named, mistyped);
  }
}

TEST(Calibrate, GoodRunsAreNotLeftOut) {
  Rng rng(8);
  std::size_t left_out = 0;
  for (int round = 0; round < testing::cases(100); ++round) {
    const auto fit = calibrate(FaultyRobot().chassis, many_runs(random_robot(rng, 0.01), rng));
    ASSERT_TRUE(fit);
    left_out += fit->left_out.size();
  }
  EXPECT_LE(left_out, static_cast<std::size_t>(testing::cases(100) / 50)) << "of 15,000 runs for 100 files";
}

TEST(Calibrate, RunsOfWhichManyDoNotFitAreRefused) {
  Rng rng(9);
  FaultyRobot robot;
  auto runs = many_runs(robot, rng);
  int changed = 0;
  for (CalibrationRun& run : runs) {
    if (run.command.ahead_mps > 0.0 && (7 * changed++) % 25 < 6) run.start_T_end.position.x *= 1.5;
  }
  const auto fit = calibrate(robot.chassis, runs);
  ASSERT_FALSE(fit);
  EXPECT_NE(to_string(fit.error()).find("of 25 runs ahead do not fit one law"), std::string::npos)
      << to_string(fit.error());
  EXPECT_EQ(fit.error().where, "runs.csv:2");
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
