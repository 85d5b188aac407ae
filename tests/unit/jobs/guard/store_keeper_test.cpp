// Missions on finite supplies: planned, executed and measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/jobs/guard/run.hpp"
#include "outrider/jobs/guard/supply_plan.hpp"
#include "outrider/report/json.hpp"
#include "support/curious.hpp"
#include "support/guard_runs.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

GuardOptions coarse() {
  GuardOptions options;
  options.resolution_m = 0.25;
  options.stops = 60;
  options.refinements = 0;
  options.iterations = 100;
  return options;
}

/// A yard of 8 x 8 m with six targets; the well and the dock are beside the start.
GuardProblem yard(std::uint64_t seed) {
  Rng rng(seed);
  GuardProblem problem = testing::random_guard_problem(rng, 2, 6, 4.0);
  problem.supplies.tank = 2.0;
  problem.supplies.battery_wh = 0.6;
  problem.supplies.stations = {{"well", problem.start.position + Vec2{0.5, 0.0}, true, false},
                               {"dock", problem.start.position + Vec2{-0.5, 0.0}, false, true}};
  return problem;
}

struct Mission {
  GuardProblem problem;
  FiringMap firing_map;
  GuardPlan plan;
};

Outcome<Mission> planned(GuardProblem problem) {
  auto firing_map = build_firing_map(problem, coarse());
  if (!firing_map) return pass_on(firing_map);
  auto plan = plan_guard(problem, *firing_map, coarse(), {});
  if (plan) plan = supply_plan(problem, *firing_map, std::move(*plan), {});
  if (!plan) return pass_on(plan);
  return Mission{std::move(problem), std::move(*firing_map), std::move(*plan)};
}

/// No store below zero or above full, and each level goes up only where the robot fills it.
void expect_sound_levels(const Report& report) {
  ASSERT_TRUE(report.supplies);
  ASSERT_FALSE(report.supplies->levels.empty());
  int filled = 0;
  for (std::size_t i = 0; i < report.supplies->levels.size(); ++i) {
    const ReportLevel& level = report.supplies->levels[i];
    EXPECT_GE(level.water, -1e-9);
    EXPECT_GE(level.charge_j, -1e-6);
    EXPECT_LE(level.water, report.supplies->tank);
    EXPECT_LE(level.charge_j, report.supplies->battery_j);
    if (i == 0) continue;
    const ReportLevel& before = report.supplies->levels[i - 1];
    if (level.water > before.water || level.charge_j > before.charge_j) ++filled;
  }
  EXPECT_LE(filled, static_cast<int>(metric(report, "fills")));
}

TEST(SupplyRun, WithoutErrorsTakesWhatItsPlanSays) {
  int fills = 0;
  for (int i = 0; i < testing::cases(4); ++i) {
    GuardProblem problem = yard(static_cast<std::uint64_t>(i));
    problem.errors = {0.0, 0.0, {0.0, 0.0}};
    const auto mission = planned(std::move(problem));
    if (!mission) continue;  // a station stands in an obstacle
    const Report report =
        testing::run_still(mission->problem, mission->firing_map, mission->plan, coarse(), 1);
    expect_sound_levels(report);
    EXPECT_NEAR(metric(report, "mission_s"), mission->plan.cost_s, 1e-6) << i;
    EXPECT_EQ(metric(report, "unplanned_fills"), 0.0) << i;
    const auto after = planned_levels(mission->problem, mission->firing_map, mission->plan);
    if (!after.empty()) {
      EXPECT_NEAR(report.supplies->levels.back().charge_j, after.back().charge, 1e-6);
      EXPECT_NEAR(report.supplies->levels.back().water, after.back().water, 1e-9);
    }
    fills += static_cast<int>(metric(report, "fills"));
  }
  EXPECT_GT(fills, 0);
}

TEST(SupplyRun, WithErrorsNeverRunsDryAndIsTheSameTwice) {
  int missions = 0;
  for (int i = 0; i < testing::cases(3); ++i) {
    const auto mission = planned(yard(static_cast<std::uint64_t>(100 + i)));
    if (!mission) continue;
    ++missions;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Report report =
          testing::run_still(mission->problem, mission->firing_map, mission->plan, coarse(), seed);
      expect_sound_levels(report);
      const std::string text = to_json(report);
      testing::Curious curious;
      EXPECT_EQ(text, to_json(testing::run_still(mission->problem, mission->firing_map, mission->plan,
                                                 coarse(), seed, {.observer = &curious})));
      curious.expect_to_have_seen(report);
      const auto again = report_from_json(text);
      ASSERT_TRUE(again) << again.error().sentence;
      EXPECT_EQ(to_json(*again), text);
    }
  }
  EXPECT_GE(missions, 2);
}

TEST(SupplyRun, SaysWhatTheSuppliesDoNotSufficeFor) {
  GuardProblem problem = yard(1);
  problem.supplies.battery_wh = 0.0;
  problem.supplies.stations.clear();
  const auto mission = planned(problem);
  ASSERT_TRUE(mission) << mission.error().sentence;
  const std::size_t hits = problem.targets.size() - mission->plan.unreachable.size();
  ASSERT_EQ(mission->plan.unsupplied.size(), hits - 2);
  EXPECT_NE(mission->plan.unsupplied[0].reason.find("no station gives water"), std::string::npos);
  const Report report = testing::run_still(mission->problem, mission->firing_map, mission->plan, coarse(), 1);
  EXPECT_EQ(report.status, "not_done");
  expect_sound_levels(report);
}

TEST(SupplyPlan, RefusesWhatIsWrong) {
  const auto says = [](GuardProblem problem, const std::string& key, const std::string& words) {
    const auto mission = planned(std::move(problem));
    ASSERT_FALSE(mission) << words;
    EXPECT_EQ(mission.error().code, FaultCode::bad_input);
    EXPECT_EQ(mission.error().where, key);
    EXPECT_NE(mission.error().sentence.find(words), std::string::npos) << mission.error().sentence;
  };
  GuardProblem problem = yard(1);
  problem.supplies.shot_water = 3.0;
  says(problem, "supplies.tank", "too small for any shot");
  problem = yard(1);
  problem.supplies.shot_j = 1e5;
  says(problem, "supplies.battery", "too little for any shot");
  problem = yard(1);
  problem.supplies.stations[0].position = {50.0, 0.0};
  says(problem, "supplies.stations", "well at (50, 0) is outside the yard");
  problem = yard(1);
  problem.supplies.stations[1].position = {3.95, 3.95};
  says(problem, "supplies.stations", "too close to an obstacle");
}

TEST(SupplyPlan, WithoutEndIsThePlanItself) {
  GuardProblem problem = yard(2);
  problem.supplies = {};
  const auto firing_map = build_firing_map(problem, coarse());
  ASSERT_TRUE(firing_map);
  const auto plan = plan_guard(problem, *firing_map, coarse(), {});
  ASSERT_TRUE(plan);
  const auto same = supply_plan(problem, *firing_map, *plan, {});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->cost_s, plan->cost_s);
  EXPECT_EQ(same->stops.size(), plan->stops.size());
}

}  // namespace
}  // namespace outrider
