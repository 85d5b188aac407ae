// The planners against the published lengths of the MovingAI grids.
#include "support/movingai.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"

namespace outrider {
namespace {

struct Published {
  const char* map;
  const char* table;
  double tolerance;  ///< relative
  std::size_t queries;
};

std::shared_ptr<const GridMap> ground_of(const std::string& map, GridModel model) {
  const auto text = movingai::text_of(map);
  if (!text) return nullptr;
  auto ground = GridMap::of(movingai::read_map(*text), model);
  return ground ? std::make_shared<const GridMap>(std::move(*ground)) : nullptr;
}

const std::vector<Published> octile_lengths = {
    {"dao/arena.map", "dao/arena.map.scen", 1e-5, 40},
    {"dao/den312d.map", "dao/den312d.map.scen", 1e-5, 16},
    {"dao/lak303d.map", "dao/lak303d.map.scen", 1e-5, 8},
    {"bg512/AR0602SR.map", "bg512/AR0602SR.map.scen", 2e-3, 6},
    {"cities/Berlin_0_512.map", "cities/Berlin_0_512.map.scen", 1e-5, 6},
    {"mazes/maze512-8-0.map", "mazes/maze512-8-0.map.scen", 1e-5, 6},
    {"random/random512-10-0.map", "random/random512-10-0.map.scen", 1e-5, 6},
    {"rooms/8room_000.map", "rooms/8room_000.map.scen", 1e-5, 6},
    {"dao/brc202d.map", "dao/brc202d.map.scen", 1e-5, 8},
    {"dao/orz900d.map", "dao/orz900d.map.scen", 1e-5, 4},
    {"mazes/maze512-1-0.map", "mazes/maze512-1-0.map.scen", 1e-5, 6},
    {"random/random512-35-0.map", "random/random512-35-0.map.scen", 1e-5, 6},
    {"sc1/Aurora.map", "sc1/Aurora.map.scen", 1e-5, 3},
};

TEST(MovingAi, PlannersOptimalAlongTheMovesHaveThePublishedLengths) {
  if (!movingai::text_of("dao/arena.map"))
    GTEST_SKIP() << "no published grids in " << movingai::data_folder();
  const int most_maps = std::clamp(testing::costly_cases(8), 3, static_cast<int>(octile_lengths.size()));
  for (const Published& set : std::span(octile_lengths).first(static_cast<std::size_t>(most_maps))) {
    const auto ground = ground_of(set.map, GridModel::cells);
    const auto table = movingai::text_of(set.table);
    ASSERT_TRUE(ground && table) << set.map;
    const int top = ground->frame.height - 1;
    for (const PathPlanner& row : path_planners()) {
      if (row.guarantee.among != PathClass::along_moves || row.guarantee.most_ratio != 1.0) continue;
      if (!row.takes(GridModel::cells) || row.guarantee.measure != Measure::length) continue;
      const ConfiguredPlanner planner = row.configure();
      movingai::limit_hub_memory(planner.options, "8");
      Workspace workspace;
      for (const movingai::Query& q : movingai::spread(movingai::read_scen(*table), set.queries)) {
        const Problem problem{ground, ground->point({q.start.x, top - q.start.y}),
                              ground->point({q.goal.x, top - q.goal.y})};
        const auto plan = planner.plan(problem, {}, workspace);
        ASSERT_TRUE(plan.has_value()) << set.map << " " << row.name << " " << plan.error().sentence;
        EXPECT_NEAR(plan->cost, q.length, set.tolerance * std::max(1.0, q.length))
            << set.map << " " << row.name;
        EXPECT_TRUE(check(*plan, problem).has_value()) << set.map << " " << row.name;
      }
    }
  }
}

const std::vector<Published> any_direction_lengths = {
    {"dao/arena.map", "anyangle/arena.csv", 1e-9, 40},
    {"dao/den312d.map", "anyangle/den312d.csv", 1e-9, 32},
    {"dao/lak303d.map", "anyangle/lak303d.csv", 1e-9, 16},
    {"bg512/AR0602SR.map", "anyangle/AR0602SR.csv", 1e-9, 10},
    {"cities/Berlin_0_512.map", "anyangle/Berlin_0_512.csv", 1e-9, 10},
    {"mazes/maze512-8-0.map", "anyangle/maze512-8-0.csv", 1e-9, 6},
    {"random/random512-10-0.map", "anyangle/random512-10-0.csv", 1e-9, 10},
    {"rooms/8room_000.map", "anyangle/8room_000.csv", 1e-9, 10},
};

/// No planner undercuts the true shortest path; those that go in any direction are near it.
TEST(MovingAi, NoPathUndercutsThePublishedShortestAndFreeDirectionsComeNear) {
  if (!movingai::text_of("anyangle/arena.csv")) {
    GTEST_SKIP() << "no published any-angle lengths in " << movingai::data_folder();
  }
  const int most_maps = std::max(3, testing::part_of(static_cast<int>(any_direction_lengths.size())));
  for (const Published& set : std::span(any_direction_lengths).first(static_cast<std::size_t>(most_maps))) {
    const auto ground = ground_of(set.map, GridModel::corners);
    const auto table = movingai::text_of(set.table);
    ASSERT_TRUE(ground && table) << set.map;
    const int top = ground->frame.height;
    const auto queries = movingai::spread(movingai::read_any_angle(*table), set.queries);
    for (const PathPlanner& row : path_planners()) {
      if (!row.takes(GridModel::corners)) continue;
      const ConfiguredPlanner planner = row.configure();
      movingai::limit_hub_memory(planner.options, "8");
      Workspace workspace;
      double sum = 0.0, least = 0.0;
      for (const movingai::Query& q : queries) {
        const Problem problem{ground, ground->point({q.start.x, top - q.start.y}),
                              ground->point({q.goal.x, top - q.goal.y})};
        const auto plan = planner.plan(problem, {}, workspace);
        ASSERT_TRUE(plan.has_value()) << set.map << " " << row.name << " " << plan.error().sentence;
        EXPECT_GE(plan->cost, q.length * (1.0 - set.tolerance) - 1e-8) << set.map << " " << row.name;
        if (row.guarantee.among == PathClass::any_direction) {
          EXPECT_LE(plan->lower_bound, q.length + 1e-8) << set.map << " " << row.name;
        }
        const auto verdict = check(*plan, problem);
        EXPECT_TRUE(verdict.has_value()) << set.map << " " << row.name << " " << to_string(verdict.error());
        sum += plan->cost;
        least += q.length;
      }
      const double most = row.guarantee.among == PathClass::any_direction ? 1.01 : 1.0824;
      EXPECT_LE(sum / least, most) << set.map << " " << row.name;
      RecordProperty(
          std::string(row.name) + std::string("_") + std::to_string(&set - any_direction_lengths.data()),
          std::to_string(sum / least));
    }
  }
}

}  // namespace
}  // namespace outrider
