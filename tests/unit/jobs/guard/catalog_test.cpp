#include "outrider/jobs/guard/catalog.hpp"

#include <gtest/gtest.h>

#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"
#include "support/sound_guard_plan.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::expect_sound;
using testing::floor_at;
using testing::random_guard_problem;

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

}  // namespace
}  // namespace outrider
