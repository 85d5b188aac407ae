#include "outrider/jobs/guard/team/team_plan.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/jobs/guard/plan/bound.hpp"
#include "outrider/motion/closest_approach.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"
#include "team/team_schedule.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::own_cost;
using testing::OwnGun;
using testing::random_guard_problem;

/// A yard with starts side by side.
struct TeamCase {
  GuardProblem problem;
  std::vector<Pose2> starts;
};

TeamCase random_team(Rng& rng, std::size_t targets, std::size_t robots) {
  TeamCase made{random_guard_problem(rng, 6, targets, 4.0), {}};
  for (std::size_t r = 0; r < robots; ++r) {
    const double side = static_cast<double>((r + 1) / 2) * (r % 2 == 0 ? -0.8 : 0.8);
    made.starts.push_back({made.problem.start.position + Vec2{side, 0.0}, made.problem.start.heading_rad});
  }
  return made;
}

/// Each target is in one stop of one robot or told unreachable, and each shot hits by other means.
void expect_each_target_once(const GuardProblem& problem, const FiringMap& firing_map, const TeamPlan& team) {
  std::vector<int> times(problem.targets.size(), 0);
  for (const Unreachable& lost : team.unreachable) ++times[lost.target];
  for (const TeamPart& part : team.parts) {
    for (const PlannedStop& stop : part.plan.stops) {
      for (const PassingHit& hit : stop.passing) ++times[hit.target];
      for (const PlannedHit& hit : stop.hits) {
        ++times[hit.target];
        const Solid target = solid_of(problem.targets[hit.target]);
        EXPECT_TRUE(
            OwnGun{problem.gun}
                .shoot(stop.position, hit.shot.shot, firing_map.space(hit.target).solids(), &target, -1.0)
                .hit);
      }
    }
  }
  EXPECT_EQ(times, std::vector<int>(problem.targets.size(), 1));
}

/// The drives at their times, by closest_approach(), which shares no code with the schedule.
void expect_apart(const GuardProblem& problem, const TeamPlan& team) {
  std::vector<TimedDrives> robots;
  for (const TeamPart& part : team.parts) {
    TimedDrives& driven = robots.emplace_back(TimedDrives{part.start, {}});
    ASSERT_EQ(part.times.begins_s.size(), part.plan.stops.size());
    for (std::size_t s = 0; s < part.plan.stops.size(); ++s)
      driven.drives.push_back({part.times.begins_s[s], part.plan.stops[s].waypoints});
  }
  const auto nearest = closest_approach(problem.robot, robots);
  ASSERT_TRUE(nearest.has_value()) << nearest.error().sentence;
  EXPECT_GE(nearest->distance_m, simulated_gap_m(problem) - 1e-6);
}

/// Without waits a robot ends when its plan alone does; each wait adds at most its length.
void expect_times_add_up(const GuardProblem& problem, const TeamPlan& team) {
  double latest_s = 0.0;
  for (const TeamPart& part : team.parts) {
    latest_s = std::max(latest_s, part.times.end_s);
    EXPECT_TRUE(std::ranges::is_sorted(part.times.begins_s));
    EXPECT_GE(part.times.end_s, part.plan.cost_s - 1e-9);
    GuardProblem own = problem;
    own.start = part.start;
    if (!part.plan.on_the_move) {
      EXPECT_NEAR(part.plan.cost_s, own_cost(own, part.plan), 1e-6);
    }
  }
  EXPECT_EQ(team.makespan_s, latest_s);
  EXPECT_LE(team.lower_bound_s, team.makespan_s + 1e-9);
}

TEST(PlanTeam, KeepsItsPromisesInRandomYards) {
  Rng rng(411);
  std::size_t shared = 0;
  for (int i = 0; i < cases(4); ++i) {
    const auto [problem, starts] = random_team(rng, 6, 2 + static_cast<std::size_t>(i) % 3);
    GuardOptions options = testing::quick();
    options.shoot_on_the_move = i % 2 == 1;
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    if (!check_starts(problem, *firing_map, starts)) continue;
    const auto team = plan_team(problem, *firing_map, starts, options, {});
    ASSERT_TRUE(team.has_value()) << team.error().sentence;
    ASSERT_EQ(team->parts.size(), starts.size());
    expect_each_target_once(problem, *firing_map, *team);
    expect_apart(problem, *team);
    expect_times_add_up(problem, *team);
    EXPECT_LE(team->makespan_s, team->alone_s + 1e-9);
    shared += team->makespan_s < 0.8 * team->alone_s ? 1 : 0;

    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto again = plan_team(problem, *firing_map, starts, options, {});
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->makespan_s, team->makespan_s);
    EXPECT_EQ(again->lower_bound_s, team->lower_bound_s);
    for (std::size_t r = 0; r < starts.size(); ++r)
      EXPECT_EQ(again->parts[r].times.begins_s, team->parts[r].times.begins_s);
  }
  EXPECT_GE(shared, 1U);
}

TEST(PlanTeam, OfOneRobotIsItsPlan) {
  Rng rng(5);
  const auto [problem, starts] = random_team(rng, 4, 1);
  const auto options = testing::quick();
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map.has_value());
  const auto team = plan_team(problem, *firing_map, starts, options, {});
  const auto alone = plan_guard(problem, *firing_map, options, {});
  ASSERT_TRUE(team.has_value() && alone.has_value());
  EXPECT_NEAR(team->alone_s, alone->cost_s, 1e-12);
  EXPECT_LE(team->makespan_s, alone->cost_s + 1e-9);
  EXPECT_LE(team->lower_bound_s, alone->cost_s);
}

TEST(PlanTeam, RefusesStartsThatAreBlockedOrTooNear) {
  Rng rng(6);
  const auto [problem, starts] = random_team(rng, 2, 2);
  const auto firing_map = build_firing_map(problem, testing::quick());
  ASSERT_TRUE(firing_map.has_value());
  const auto sentence = [&, &problem = problem](Pose2 second) {
    const auto team = plan_team(problem, *firing_map, {problem.start, second}, testing::quick(), {});
    return team ? std::string() : team.error().sentence;
  };
  EXPECT_NE(sentence({problem.start.position + Vec2{0.3, 0.0}, 0.0}).find("0.30 m apart"), std::string::npos);
  EXPECT_NE(sentence({{90.0, 0.0}, 0.0}).find("robot 2 at 90.00,0.00"), std::string::npos);
  EXPECT_NE(sentence({{std::nan(""), 0.0}, 0.0}).find("finite"), std::string::npos);
}

TEST(KeepApart, IsSafeAndNotFarTooCareful) {
  Rng rng(23);
  const RobotModel robot;
  const double gap_m = 0.74;
  int apart = 0, needless = 0;
  for (int i = 0; i < cases(400); ++i) {
    std::vector<TimedDrives> robots;
    std::vector<std::vector<Presence>> present;
    for (int r = 0; r < 2; ++r) {
      const auto place = [&] { return Vec2{rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0)}; };
      const Pose2 start{place(), rng.uniform(-pi, pi)};
      const TimedDrive drive{rng.uniform(0.0, 4.0), {start.position, place(), place(), place()}};
      robots.push_back({start, {drive}});
      present.push_back({{0.0, drive.begin_s, {start.position, start.position}}});
      const auto driven = presences(robot, start.heading_rad, drive.waypoints, drive.begin_s, 0.0);
      present.back().insert(present.back().end(), driven.begin(), driven.end());
      EXPECT_NEAR(driven.back().begin_s,
                  drive.begin_s + drive_cost(robot, start.heading_rad, drive.waypoints).time_s, 1e-9);
    }
    const auto nearest = closest_approach(robot, robots);
    ASSERT_TRUE(nearest.has_value());
    const bool kept = keep_apart(present[0], present[1], gap_m);
    EXPECT_EQ(kept, keep_apart(present[1], present[0], gap_m));
    if (kept) {
      EXPECT_GE(nearest->distance_m, gap_m - 1e-9);
    }
    apart += kept ? 1 : 0;
    // Two pieces of 0.25 s are at most 0.2 m long each.
    needless += !kept && nearest->distance_m > gap_m + 0.4 ? 1 : 0;
  }
  EXPECT_GT(apart, cases(400) / 8);
  EXPECT_EQ(needless, 0);
}

TEST(KeepApart, HoldsForDrivesThatEndBesideTheirGoals) {
  Rng rng(24);
  const RobotModel robot;
  const double gap_m = 0.54, error_m = 0.1;
  int apart = 0;
  for (int i = 0; i < cases(2000); ++i) {
    std::vector<TimedDrives> robots;
    std::vector<std::vector<Presence>> present;
    for (int r = 0; r < 2; ++r) {
      const auto place = [&] { return Vec2{rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)}; };
      const Pose2 start{place(), rng.uniform(-pi, pi)};
      TimedDrive drive{rng.uniform(0.0, 4.0), {start.position, place(), place()}};
      if (i % 4 == 0) drive.waypoints.back() = drive.waypoints[1] + 0.05 * direction(rng.uniform(-pi, pi));
      present.push_back({{0.0, drive.begin_s, {start.position, start.position}}});
      const auto driven = presences(robot, start.heading_rad, drive.waypoints, drive.begin_s, error_m);
      present.back().insert(present.back().end(), driven.begin(), driven.end());
      drive.waypoints.back() = drive.waypoints.back() + error_m * direction(rng.uniform(-pi, pi));
      robots.push_back({start, {drive}});
    }
    if (!keep_apart(present[0], present[1], gap_m + 2.0 * error_m)) continue;
    ++apart;
    const auto nearest = closest_approach(robot, robots);
    ASSERT_TRUE(nearest.has_value());
    EXPECT_GE(nearest->distance_m, gap_m - 1e-9);
  }
  EXPECT_GT(apart, cases(2000) / 20);
}

/// Plans with one drive each, across an empty yard.
struct Drivers {
  GuardProblem one, other;
  GuardPlan of_one, of_other;
  FiringMap firing_map;
};

Drivers drivers(Vec2 from, Vec2 to, Vec2 other_from, Vec2 other_to) {
  GuardProblem problem;
  problem.world.bounds = {{-4, -4}, {4, 4}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {from, 0.0};
  GuardProblem other = problem;
  other.start = {other_from, 0.0};
  auto firing_map = build_firing_map(problem, testing::quick());
  GuardPlan of_one, of_other;
  of_one.stops.push_back({to, {from, to}, {}});
  of_other.stops.push_back({other_to, {other_from, other_to}, {}});
  return {problem, other, of_one, of_other, std::move(*firing_map)};
}

TEST(ScheduleTeam, LetsOneWaitWhereWaysCross) {
  const Drivers two = drivers({-2, 0}, {2, 0}, {0, -2}, {0, 2});
  const double gap_m = team_gap_m(two.one);
  const auto times = schedule_team(two.firing_map, {{two.one, two.of_one}, {two.other, two.of_other}}, gap_m);
  ASSERT_TRUE(times.has_value());
  const double one_s = (*times)[0].begins_s[0], other_s = (*times)[1].begins_s[0];
  EXPECT_EQ(std::min(one_s, other_s), 0.0);
  EXPECT_GT(std::max(one_s, other_s), 0.0);
  EXPECT_LT(std::max(one_s, other_s), 2.0);
  const auto nearest =
      closest_approach(two.one.robot, {{two.one.start, {{one_s, two.of_one.stops[0].waypoints}}},
                                       {two.other.start, {{other_s, two.of_other.stops[0].waypoints}}}});
  ASSERT_TRUE(nearest.has_value());
  EXPECT_GE(nearest->distance_m, gap_m);
}

TEST(ScheduleTeam, HasNothingForTwoThatChangePlaces) {
  const Drivers two = drivers({-2, 0}, {2, 0}, {2, 0}, {-2, 0});
  EXPECT_FALSE(schedule_team(two.firing_map, {{two.one, two.of_one}, {two.other, two.of_other}}, 0.8));
}

TEST(ScheduleTeam, LetsOneLeaveBeforeTheOtherComes) {
  const Drivers two = drivers({-2, 0}, {2, 0}, {2, 0}, {2, 3});
  const auto times = schedule_team(two.firing_map, {{two.one, two.of_one}, {two.other, two.of_other}}, 0.8);
  ASSERT_TRUE(times.has_value());
  EXPECT_EQ((*times)[1].begins_s[0], 0.0);
}

/// Bound of a team by trying all partitions of the targets with the bound of one robot.
TEST(TeamBound, IsAtMostThatOfTheBestPartition) {
  Rng rng(77);
  for (int i = 0; i < cases(3); ++i) {
    const auto [problem, starts] = random_team(rng, 4, 2);
    GuardOptions options = testing::quick();
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value());
    std::vector<std::size_t> targets;
    for (std::size_t t = 0; t < problem.targets.size(); ++t) {
      if (firing_map->regions[t].hits > 0) targets.push_back(t);
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t mask = 0; mask < std::size_t{1} << targets.size(); ++mask) {
      std::vector<std::size_t> own, other;
      for (std::size_t k = 0; k < targets.size(); ++k)
        ((mask >> k & 1U) != 0 ? own : other).push_back(targets[k]);
      GuardProblem second = problem;
      second.start = starts[1];
      least = std::min(least, std::max(mission_bound(problem, *firing_map, own, options, {}),
                                       mission_bound(second, *firing_map, other, options, {})));
    }
    const double bound = team_bound(problem, *firing_map, targets, starts, options, {});
    EXPECT_LE(bound, least + 1e-9);
    EXPECT_GT(bound, 0.0);
  }
}

}  // namespace
}  // namespace outrider
