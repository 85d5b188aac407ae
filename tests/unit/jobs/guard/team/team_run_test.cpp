#include "outrider/jobs/guard/team/team_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

/// Two to four robots side by side at the south of a yard.
std::vector<Pose2> starts_at(const GuardProblem& problem, std::size_t robots) {
  std::vector<Pose2> starts;
  for (std::size_t r = 0; r < robots; ++r) {
    const double side = static_cast<double>((r + 1) / 2) * (r % 2 == 0 ? -0.8 : 0.8);
    starts.push_back({problem.start.position + Vec2{side, 0.0}, problem.start.heading_rad});
  }
  return starts;
}

std::vector<TimedDrives> driven_in(const TeamRun& run) {
  std::vector<TimedDrives> driven;
  for (const TeamRobotRun& robot : run.robots) driven.push_back(robot.driven);
  return driven;
}

TEST(RunTeam, SettlesEveryTargetAndKeepsApart) {
  Rng rng(612);
  std::size_t reached = 0, targets = 0, ran = 0;
  for (int i = 0; i < cases(4); ++i) {
    auto problem = testing::random_guard_problem(rng, 6, 6, 3.5);
    const auto starts = starts_at(problem, 2 + static_cast<std::size_t>(i) % 3);
    GuardOptions options = testing::quick();
    options.shoot_on_the_move = i % 2 == 1;
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    if (!check_starts(problem, *firing_map, starts)) continue;
    const auto plan = plan_team(problem, *firing_map, starts, options, {});
    ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
    const TeamRun run = run_team(problem, *firing_map, *plan, static_cast<std::uint64_t>(i));
    EXPECT_FALSE(run.ended_early);
    const auto nearest = closest_approach(problem.robot, driven_in(run));
    ASSERT_TRUE(nearest.has_value()) << nearest.error().sentence;
    EXPECT_GE(nearest->distance_m, 2.0 * problem.robot.radius_m);
    for (const TargetRecord& record : run.records) {
      EXPECT_NE(record.status, TargetStatus::waiting);
      reached += record.status == TargetStatus::reached ? 1 : 0;
      targets += record.status == TargetStatus::unreachable ? 0 : 1;
    }
    ++ran;

    const TeamRun again = run_team(problem, *firing_map, *plan, static_cast<std::uint64_t>(i));
    EXPECT_EQ(again.mission_s, run.mission_s);
    EXPECT_EQ(again.waited_s, run.waited_s);
  }
  EXPECT_GE(ran, static_cast<std::size_t>(cases(4)) / 2);
  EXPECT_GE(10 * reached, 9 * targets);
}

/// Without errors the run takes what the plan says, but for the steps of waits.
TEST(RunTeam, EndsWithoutErrorsWhenItsPlanDoes) {
  Rng rng(90);
  auto problem = testing::random_guard_problem(rng, 4, 5, 3.0);
  problem.errors = {0.0, 0.0, {0.0, 0.0}, 0.0};
  const auto starts = starts_at(problem, 2);
  const GuardOptions options = testing::quick();
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map.has_value());
  const auto plan = plan_team(problem, *firing_map, starts, options, {});
  ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
  const TeamRun run = run_team(problem, *firing_map, *plan, 1);
  EXPECT_LE(run.mission_s, plan->makespan_s + 2.0);  // waits are tried in steps
  EXPECT_GE(run.mission_s, plan->lower_bound_s);
}

/// A robot without targets stands where the other one has to go.
TEST(RunTeam, GivesAStopUpThatNobodyLeaves) {
  Rng rng(91);
  std::size_t given_up = 0, ran = 0;
  for (int i = 0; i < cases(4); ++i) {
    auto problem = testing::random_guard_problem(rng, 4, 3, 4.0);
    problem.gun.muzzle_speed_mps = 5.0;  // it has to go near
    const auto firing_map = build_firing_map(problem, testing::quick());
    ASSERT_TRUE(firing_map.has_value());
    auto plan = plan_team(problem, *firing_map, {problem.start}, testing::quick(), {});
    ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
    if (plan->parts[0].plan.stops.empty()) continue;
    const Vec2 stop = plan->parts[0].plan.stops.back().position;
    if (distance(stop, problem.start.position) < team_gap_m(problem)) continue;
    plan->parts.push_back({{stop, 0.0}, {}});
    const TeamRun run = run_team(problem, *firing_map, *plan, 3);
    const auto nearest = closest_approach(problem.robot, driven_in(run));
    ASSERT_TRUE(nearest.has_value()) << nearest.error().sentence;
    EXPECT_GE(nearest->distance_m, 2.0 * problem.robot.radius_m);
    for (const TargetRecord& record : run.records) EXPECT_NE(record.status, TargetStatus::waiting);
    given_up += run.given_up;
    ++ran;
  }
  EXPECT_GT(ran, 0U);
  EXPECT_GT(given_up, 0U);
}

/// A robot without targets stands in the middle of the way of the other one, on open ground.
TEST(RunTeam, DrivesAroundARobotThatStays) {
  GuardProblem problem;
  problem.world.bounds = {{-5, -4}, {5, 4}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{-4.0, 0.0}, 0.0};
  problem.gun.muzzle_speed_mps = 4.0;  // it has to go near
  problem.targets = {{"cat", {4.0, 0.0, 0.0}, {0.3, 0.3, 0.3}}};
  const auto firing_map = build_firing_map(problem, testing::from_rest());
  ASSERT_TRUE(firing_map.has_value());
  auto plan = plan_team(problem, *firing_map, {problem.start}, testing::from_rest(), {});
  ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
  plan->parts.push_back({{{0.0, 0.0}, 0.0}, {}});
  const TeamRun run = run_team(problem, *firing_map, *plan, 3);
  EXPECT_EQ(run.given_up, 0U);
  EXPECT_EQ(run.records[0].status, TargetStatus::reached) << run.records[0].reason;
  const auto nearest = closest_approach(problem.robot, {run.robots[0].driven, run.robots[1].driven});
  ASSERT_TRUE(nearest.has_value()) << nearest.error().sentence;
  EXPECT_GE(nearest->distance_m, 2.0 * problem.robot.radius_m);
}

}  // namespace
}  // namespace outrider
