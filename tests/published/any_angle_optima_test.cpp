// The planners that claim the shortest path in any direction, against published optima: against all of them
// under `make soak`.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "support/movingai.hpp"

namespace outrider {
namespace {

const std::vector<std::pair<const char*, const char*>> maps_and_tables = {
    {"dao/arena.map", "arena"},
    {"dao/den312d.map", "den312d"},
    {"dao/lak303d.map", "lak303d"},
    {"bg512/AR0602SR.map", "AR0602SR"},
    {"cities/Berlin_0_512.map", "Berlin_0_512"},
    {"mazes/maze512-8-0.map", "maze512-8-0"},
    {"random/random512-10-0.map", "random512-10-0"},
    {"rooms/8room_000.map", "8room_000"},
    {"dao/brc202d.map", "brc202d"},
    {"dao/orz900d.map", "orz900d"},
    {"cities/London_1_1024.map", "London_1_1024"},
    {"random/random512-35-0.map", "random512-35-0"},
    {"sc1/Aurora.map", "Aurora"},
};

bool claims_the_optimum(const PathPlanner& row) {
  return row.takes(GridModel::corners) && row.guarantee.among == PathClass::any_direction &&
         row.guarantee.most_ratio == 1.0;
}

TEST(AnyAngleOptima, AreReachedOnPublishedQueries) {
  if (!movingai::text_of("anyangle/arena.csv")) {
    GTEST_SKIP() << "no published any-angle lengths in " << movingai::data_folder();
  }
  const int most_maps = std::clamp(testing::costly_cases(8), 3, static_cast<int>(maps_and_tables.size()));
  for (const auto& [map, table] : std::span(maps_and_tables).first(static_cast<std::size_t>(most_maps))) {
    const auto text = movingai::text_of(map);
    const auto optima = movingai::text_of(std::string("anyangle/") + table + ".csv");
    ASSERT_TRUE(text && optima) << map;
    const auto ground =
        std::make_shared<const GridMap>(*GridMap::of(movingai::read_map(*text), GridModel::corners));
    const int top = ground->frame.height;
    const auto published = movingai::read_any_angle(*optima);
    EXPECT_GE(published.size(), 100U) << map;
    const auto queries = movingai::spread(published, 40);
    for (const PathPlanner& row : path_planners()) {
      if (!claims_the_optimum(row)) continue;
      const ConfiguredPlanner planner = row.configure();
      movingai::limit_hub_memory(planner.options, "16");
      Workspace workspace;
      for (const movingai::Query& q : queries) {
        const Problem problem{ground, ground->point({q.start.x, top - q.start.y}),
                              ground->point({q.goal.x, top - q.goal.y})};
        const auto plan = planner.plan(problem, {}, workspace);
        ASSERT_TRUE(plan.has_value()) << map << " " << row.name << " " << plan.error().sentence;
        EXPECT_NEAR(plan->cost, q.length, 1e-6) << map << " " << row.name;
        const auto verdict = check(*plan, problem);
        EXPECT_TRUE(verdict.has_value()) << map << " " << row.name << " " << to_string(verdict.error());
      }
    }
  }
}

}  // namespace
}  // namespace outrider
