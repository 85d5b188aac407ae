// Many goals from one start: one search answers what as many single queries answer.
#include <gtest/gtest.h>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/grid/dijkstra.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "polygon_worlds.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

/// Each answer with that of the single query; costs alike, and the same bytes where `same_way`.
void expect_alike(const PathPlanner& row, const Problem& problem, const std::vector<Vec2>& goals,
                  Workspace& workspace, bool same_way) {
  const ConfiguredPlanner planner = row.configure();
  const auto plans = plan_each(planner, problem, goals, {}, workspace);
  ASSERT_EQ(plans.size(), goals.size());
  for (std::size_t i = 0; i < goals.size(); ++i) {
    Problem one = problem;
    one.goal = goals[i];
    const auto single = planner.plan(one, {}, workspace);
    ASSERT_EQ(plans[i].has_value(), single.has_value()) << row.name;
    if (!single) {
      EXPECT_EQ(to_string(plans[i].error()), to_string(single.error()));
      continue;
    }
    const auto verdict = check(*plans[i], one);
    ASSERT_TRUE(verdict.has_value()) << row.name << ": " << verdict.error().sentence;
    ASSERT_NEAR(plans[i]->cost, single->cost, 1e-9 * std::max(1.0, single->cost)) << row.name;
    ASSERT_NEAR(plans[i]->lower_bound, single->lower_bound, 1e-9 * std::max(1.0, single->cost)) << row.name;
    if (!same_way) continue;
    Plan same = *plans[i];
    same.counters = single->counters;
    EXPECT_EQ(same, *single) << row.name;
  }
}

TEST(ManyGoals, OnGridsTheyAreTheSingleQueriesByteForByte) {
  Rng rng = Rng(41).child("grids");
  Workspace workspace;
  for (int i = 0; i < testing::cases(300); ++i) {
    const auto grid = random_grid(rng, 20);
    for (const GridModel model : {GridModel::cells, GridModel::corners}) {
      auto ground = GridMap::of(grid, model);
      ASSERT_TRUE(ground.has_value());
      const auto place = [&] {
        return Vec2{rng.uniform(-1.0, grid.frame.width + 1.0), rng.uniform(-1.0, grid.frame.height + 1.0)};
      };
      const Problem problem{std::make_shared<const GridMap>(std::move(*ground)), place(), {}};
      std::vector<Vec2> goals;
      for (std::uint64_t k = rng.below(12); k > 0; --k) goals.push_back(place());
      if (!goals.empty()) goals.push_back(goals.front());
      goals.push_back(problem.start);
      for (const PathPlanner& row : path_planners()) {
        if (!row.takes(model) || !row.configure().plan_many) continue;
        expect_alike(row, problem, goals, workspace, true);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(ManyGoals, OnPolygonsTheyCostWhatTheSingleQueriesCost) {
  Rng rng = Rng(42).child("polygons");
  Workspace workspace;
  for (int i = 0; i < testing::cases(150); ++i) {
    const testing::PolygonWorld world = testing::random_world(rng);
    auto ground = PolygonGround::of(world.boundary, world.obstacles, world.radius_m);
    ASSERT_TRUE(ground.has_value());
    const Problem problem{nullptr,
                          testing::random_place(rng, world),
                          {},
                          std::make_shared<const PolygonGround>(std::move(*ground))};
    std::vector<Vec2> goals{problem.start, {1e9, 0.0}};
    for (std::uint64_t k = rng.below(10); k > 0; --k) goals.push_back(testing::random_place(rng, world));
    goals.push_back(goals.back());
    for (const PathPlanner& row : path_planners()) {
      if (!row.polygons || !row.configure().plan_many) continue;
      expect_alike(row, problem, goals, workspace, false);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(ManyGoals, OneSearchExpandsNoMoreThanItsFarthestGoalNeeds) {
  const Grid<std::uint8_t> empty(GridFrame{{0.0, 0.0}, 1.0, 40, 40});
  auto ground = GridMap::of(empty, GridModel::cells);
  ASSERT_TRUE(ground.has_value());
  const Problem problem{std::make_shared<const GridMap>(std::move(*ground)), {0.5, 0.5}, {30.5, 30.5}};
  Workspace workspace;
  const auto farthest = dijkstra(problem, {}, {}, workspace);
  const std::vector<Vec2> goals = {{5.5, 0.5}, problem.goal, {0.5, 7.5}};
  const auto plans = dijkstra_many(problem, goals, {}, {}, workspace);
  ASSERT_TRUE(plans[1].has_value());
  EXPECT_EQ(plans[1]->counters.expansions, farthest->counters.expansions);

  Budget budget;
  budget.expansions = farthest->counters.expansions - 1;
  const auto some = dijkstra_many(problem, goals, {}, budget, workspace);
  EXPECT_TRUE(some[0].has_value());
  EXPECT_TRUE(some[2].has_value());
  ASSERT_FALSE(some[1].has_value());
  EXPECT_EQ(some[1].error().code, FaultCode::budget_exhausted);
  EXPECT_TRUE(dijkstra_many(problem, {}, {}, {}, workspace).empty());
}

}  // namespace
}  // namespace outrider
