#include "research/guard/reference.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"
#include "support/sound_guard_plan.hpp"

namespace outrider {
namespace {

using testing::expect_sound;
using testing::floor_at;

TEST(ResearchGuardPlanners, KeepThePromisesOfTheCatalogue) {
  Rng rng(91);
  const auto circles = [](const auto&... given) { return shrinking_circles(given...); };
  for (int i = 0; i < testing::cases(6); ++i) {
    auto problem = testing::random_guard_problem(rng, 10, 1 + static_cast<std::size_t>(i) % 6, 2.5);
    problem.targets_block = i % 3 == 0;
    if (i % 4 == 1) problem.targets[0].base.z = 7.0;
    GuardOptions options = testing::from_rest();
    options.resolution_m = 0.15;
    options.iterations = 300;
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    for (int method = 0; method < 3; ++method) {
      const auto plan = method == 0   ? circles(problem, *firing_map, options, Budget{})
                        : method == 1 ? circles_in_order(problem, *firing_map, options, {})
                                      : source_target_table(problem, *firing_map, options, {});
      ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
      expect_sound(problem, *firing_map, *plan, options, fmt::format("method {}, case {}", method, i));
    }
  }
}

/// A row of targets in an open yard; the middle ones are listed last.
GuardProblem row_of_targets() {
  GuardProblem problem;
  problem.world.bounds = {{-12, -3}, {12, 3}};
  problem.world.solids = {floor_at(0)};
  problem.start = {{0, -2.5}, radians(90)};
  problem.gun.muzzle_speed_mps = 3.0;
  for (const double x : {-10.0, 10.0, -6.0, 6.0, -2.0, 2.0}) {
    problem.targets.push_back({fmt::format("at {}", x), {x, 1, 0}, {0.5, 0.2, 0.4}, 0.0});
  }
  return problem;
}

TEST(ResearchShrinkingCircles, TakeTheFirstPlaceOfTheLargestCircleAndListedGroups) {
  const GuardProblem problem = row_of_targets();
  const GuardOptions options = testing::from_rest();
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map.has_value());
  const auto plan = shrinking_circles(problem, *firing_map, options, {}, 2);
  ASSERT_TRUE(plan.has_value());
  ASSERT_EQ(plan->stops.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(plan->stops[i].hits.front().target / 2, i / 2) << "groups keep their order";
  }
  // No cell much farther out has a shot: the places are on the rim of the regions.
  for (const PlannedStop& stop : plan->stops) {
    const std::size_t t = stop.hits.front().target;
    double farthest = 0.0;
    for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
      if (firing_map->regions[t].pitch[c] == FiringRegion::no_shot) continue;
      farthest = std::max(farthest, distance(firing_map->frame.centre(firing_map->frame.cell(c)),
                                             xy(problem.targets[t].base)));
    }
    EXPECT_GT(distance(stop.position, xy(problem.targets[t].base)), farthest - 0.7);
  }
}

TEST(ResearchShrinkingCircles, OneGroupOfAllIsTheBestOrderOfDrives) {
  const GuardProblem problem = row_of_targets();
  const GuardOptions options = testing::from_rest();
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map.has_value());
  const auto plan = shrinking_circles(problem, *firing_map, options, {}, 6);
  ASSERT_TRUE(plan.has_value());
  std::vector<Vec2> places;
  double driven = 0.0;
  Vec2 at = problem.start.position;
  for (const PlannedStop& stop : plan->stops) {
    places.push_back(stop.position);
    driven += testing::own_duration(distance(at, stop.position), problem.robot.speed_mps,
                                    problem.robot.acceleration_mps2);
    at = stop.position;
  }
  std::sort(places.begin(), places.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
  do {
    double other = 0.0;
    at = problem.start.position;
    for (const Vec2 p : places) {
      other +=
          testing::own_duration(distance(at, p), problem.robot.speed_mps, problem.robot.acceleration_mps2);
      at = p;
    }
    EXPECT_LE(driven, other + 1e-6);
  } while (std::next_permutation(places.begin(), places.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; }));
  const auto listed = shrinking_circles(problem, *firing_map, options, {}, 1);
  ASSERT_TRUE(listed.has_value());
  EXPECT_GT(listed->cost_s, plan->cost_s + 10.0);
}

TEST(ResearchSourceTargetTable, GoesToTheNearestPlaceWithATargetLeft) {
  const GuardProblem problem = row_of_targets();
  const auto firing_map = build_firing_map(problem, {});
  ASSERT_TRUE(firing_map.has_value());
  const auto plan = source_target_table(problem, *firing_map, {}, {});
  ASSERT_TRUE(plan.has_value());
  std::vector<bool> left(problem.targets.size(), true);
  Vec2 at = problem.start.position;
  for (const PlannedStop& stop : plan->stops) {
    for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
      const Cell cell = firing_map->frame.cell(c);
      if (cell.x % 5 != 0 || cell.y % 5 != 0) continue;
      for (std::size_t t = 0; t < left.size(); ++t) {
        if (!left[t] || firing_map->regions[t].pitch[c] == FiringRegion::no_shot) continue;
        EXPECT_GE(distance(at, firing_map->frame.centre(cell)), distance(at, stop.position) - 1e-9);
      }
    }
    for (const PlannedHit& hit : stop.hits) left[hit.target] = false;
    at = stop.position;
  }
}

}  // namespace
}  // namespace outrider
