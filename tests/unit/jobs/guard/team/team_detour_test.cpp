#include "team/team_detour.hpp"

#include <gtest/gtest.h>

#include "outrider/jobs/guard/team/team_run.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

TEST(WayAround, IsFreeAndApartInRandomYards) {
  Rng rng(19);
  int found = 0, led = 0;
  for (int i = 0; i < cases(40); ++i) {
    const auto problem = testing::random_guard_problem(rng, 8, 1, 3.0);
    const auto firing_map = build_firing_map(problem, testing::quick());
    ASSERT_TRUE(firing_map.has_value());
    std::vector<Vec2> places;
    for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
      if (firing_map->reachable[c] != 0)
        places.push_back(firing_map->frame.centre(firing_map->frame.cell(c)));
    }
    const auto place = [&] { return places[rng.below(places.size())]; };
    const Vec2 from = place(), to = place();
    const std::vector<Vec2> standing{place(), 0.5 * (from + to)};
    const double gap_m = 0.7;
    const auto way = way_around(problem, *firing_map, from, to, standing, gap_m);
    if (!way) continue;
    ++found;
    led += way->size() > 2 ? 1 : 0;
    EXPECT_EQ(way->front(), from);
    EXPECT_EQ(way->back(), to);
    for (std::size_t k = 1; k < way->size(); ++k) {
      const Vec2 a = (*way)[k - 1], b = (*way)[k];
      for (int s = 0; s <= 200; ++s) {
        const Vec2 at = a + s / 200.0 * (b - a);
        EXPECT_GE(firing_map->ground.clearance(at, 1.0), problem.robot.radius_m - 1e-9);
        for (const Vec2 other : standing) EXPECT_GE(distance(at, other), gap_m - 1e-9);
      }
    }
  }
  EXPECT_GT(found, cases(40) / 8);
  EXPECT_GT(led, 0);
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
  plan->parts.push_back({{{0.0, 0.0}, 0.0}, {}, {}, {}, 0.0});
  const TeamRun run = run_team(problem, *firing_map, *plan, 3);
  EXPECT_EQ(run.given_up, 0U);
  EXPECT_EQ(run.records[0].status, TargetStatus::reached) << run.records[0].reason;
  const auto nearest = closest_approach(problem.robot, {run.robots[0].driven, run.robots[1].driven});
  ASSERT_TRUE(nearest.has_value()) << nearest.error().sentence;
  EXPECT_GE(nearest->distance_m, 2.0 * problem.robot.radius_m);
}

}  // namespace
}  // namespace outrider
