#include "outrider/jobs/guard/catalog.hpp"

#include <gtest/gtest.h>

#include "outrider/jobs/guard/reference.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::floor_at;
using testing::own_cost;
using testing::OwnGun;
using testing::random_guard_problem;

/// The promises of every planner, by other means than those of the planners.
void expect_sound(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                  const GuardOptions& options, const std::string& what) {
  std::vector<int> times(problem.targets.size(), 0);
  for (const Unreachable& lost : plan.unreachable) {
    ++times[lost.target];
    EXPECT_FALSE(lost.reason.empty()) << what;
  }
  Vec2 at = problem.start.position;
  for (const PlannedStop& stop : plan.stops) {
    ASSERT_FALSE(stop.waypoints.empty()) << what;
    EXPECT_LT(distance(stop.waypoints.front(), at), 1e-9) << what;
    EXPECT_LT(distance(stop.waypoints.back(), stop.position), 1e-9) << what;
    at = stop.position;
    for (std::size_t i = 1; i < stop.waypoints.size(); ++i) {
      for (int k = 0; k <= 100; ++k) {
        const Vec2 p = stop.waypoints[i - 1] + k / 100.0 * (stop.waypoints[i] - stop.waypoints[i - 1]);
        EXPECT_GE(firing_map.ground.clearance(p, 1.0), problem.robot.radius_m - 2e-9) << what;
      }
    }
    EXPECT_FALSE(stop.hits.empty()) << what;
    for (const PlannedHit& hit : stop.hits) {
      ++times[hit.target];
      const Solid target = solid_of(problem.targets[hit.target]);
      const auto end = OwnGun{problem.gun}.shoot(stop.position, hit.shot.shot,
                                                 firing_map.space(hit.target).solids(), &target, -1.0);
      EXPECT_TRUE(end.hit) << what << ": " << problem.targets[hit.target].name;
      EXPECT_NEAR(end.time_s, hit.shot.flight_s, 2e-4) << what;
      EXPECT_GE(end.gap_m, options.margin_m - 3e-4) << what;
    }
  }
  for (const int count : times) EXPECT_EQ(count, 1) << what;
  EXPECT_NEAR(plan.cost_s, own_cost(problem, plan), 1e-6) << what;
  EXPECT_LE(plan.lower_bound_s, plan.bounded_s() + 1e-9) << what;
}

TEST(GuardCatalog, EveryPlannerKeepsItsPromises) {
  Rng rng(91);
  std::vector<std::size_t> hit(guard_planners().size(), 0);
  for (int i = 0; i < cases(6); ++i) {
    auto problem = random_guard_problem(rng, 10, 1 + static_cast<std::size_t>(i) % 6, 2.5);
    problem.targets_block = i % 3 == 0;
    if (i % 4 == 1) problem.targets[0].base.z = 7.0;
    GuardOptions options = testing::from_rest();
    options.resolution_m = 0.15;
    options.stops = 60;
    options.iterations = 300;
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    for (std::size_t p = 0; p < hit.size(); ++p) {
      const GuardPlanner& planner = guard_planners()[p];
      const std::string what = std::string(planner.name) + ", case " + std::to_string(i);
      const auto plan = planner.plan(problem, *firing_map, options, {});
      const auto again = planner.plan(problem, *firing_map, options, {});
      ASSERT_TRUE(plan.has_value()) << what << ": " << plan.error().sentence;
      ASSERT_TRUE(again.has_value()) << what;
      expect_sound(problem, *firing_map, *plan, options, what);
      hit[p] += problem.targets.size() - plan->unreachable.size();
      EXPECT_EQ(plan->cost_s, again->cost_s) << what;
      ASSERT_EQ(plan->stops.size(), again->stops.size()) << what;
      for (std::size_t s = 0; s < plan->stops.size(); ++s) {
        EXPECT_EQ(plan->stops[s].waypoints, again->stops[s].waypoints) << what;
      }
    }
  }
  for (std::size_t p = 0; p < hit.size(); ++p) EXPECT_GT(hit[p], 10U) << guard_planners()[p].name;
}

TEST(GuardCatalog, EveryPlannerIsContentWithoutTargetsAndWithoutShots) {
  GuardProblem problem;
  problem.world.bounds = {{-2, -2}, {2, 2}};
  problem.world.solids = {floor_at(0)};
  problem.start = {{0, -1.5}, radians(90)};
  for (const bool kite : {false, true}) {
    if (kite) problem.targets = {{"kite", {0, 0, 9}, {0.5, 0.2, 0.4}, 0.0}};
    const auto firing_map = build_firing_map(problem, {});
    ASSERT_TRUE(firing_map.has_value());
    for (const GuardPlanner& planner : guard_planners()) {
      const auto plan = planner.plan(problem, *firing_map, {}, {});
      ASSERT_TRUE(plan.has_value()) << planner.name;
      EXPECT_TRUE(plan->stops.empty()) << planner.name;
      EXPECT_EQ(plan->unreachable.size(), problem.targets.size()) << planner.name;
    }
  }
}

TEST(GuardCatalog, AnUnknownNameIsToldTheNearest) {
  EXPECT_TRUE(find_guard_planner("best_tour"));
  EXPECT_EQ(guard_planners().front().name, GuardOptions{}.planner);
  const auto unknown = find_guard_planner("best_tuor");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().sentence.find("did you mean 'best_tour'"), std::string::npos);
  EXPECT_EQ(unknown.error().where, "plan.planner");
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

TEST(ShrinkingCircles, TakeTheFirstPlaceOfTheLargestCircleAndListedGroups) {
  const GuardProblem problem = row_of_targets();
  GuardOptions options = testing::from_rest();
  options.group = 2;
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map.has_value());
  const auto plan = shrinking_circles(problem, *firing_map, options, {});
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

TEST(ShrinkingCircles, OneGroupOfAllIsTheBestOrderOfDrives) {
  const GuardProblem problem = row_of_targets();
  GuardOptions options = testing::from_rest();
  options.group = 6;
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map.has_value());
  const auto plan = shrinking_circles(problem, *firing_map, options, {});
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
  options.group = 1;
  const auto listed = shrinking_circles(problem, *firing_map, options, {});
  ASSERT_TRUE(listed.has_value());
  EXPECT_GT(listed->cost_s, plan->cost_s + 10.0);
}

TEST(SourceTargetTable, GoesToTheNearestPlaceWithATargetLeft) {
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
