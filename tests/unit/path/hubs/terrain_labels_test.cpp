// Labels of ground with costs against A* on the same ground, and the order of hubs.
#include "outrider/path/hubs/terrain_labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hubs/dissection_order.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/grid/terrain/terrain_a_star.hpp"
#include "support/random_cases.hpp"
#include "support/random_costs.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

std::shared_ptr<const CellCosts> random_costs(Rng& rng, const GridFrame& frame) {
  return std::make_shared<const CellCosts>(CellCosts::of(testing::random_costs(rng, frame)).value());
}

std::shared_ptr<const GridMap> ground_of(const Grid<std::uint8_t>& blocked) {
  return std::make_shared<const GridMap>(GridMap::of(blocked, GridModel::cells).value());
}

Vec2 any_point(Rng& rng, const GridFrame& frame) {
  return {rng.uniform(0, frame.width), rng.uniform(0, frame.height)};
}

void expect_the_cost_of_a_star(const Problem& problem, Workspace& workspace, bool by_index) {
  const auto expected = terrain_a_star(problem, {}, {}, workspace);
  const auto plan = terrain_labels(problem, {}, {}, workspace);
  ASSERT_EQ(plan.has_value(), expected.has_value());
  if (!plan) {
    EXPECT_EQ(plan.error().code, expected.error().code);
    EXPECT_EQ(plan.error().sentence, expected.error().sentence);
    return;
  }
  EXPECT_NEAR(plan->cost, expected->cost, 1e-9 * expected->cost);
  EXPECT_EQ(plan->lower_bound, plan->cost);
  EXPECT_EQ(plan->remark.empty(), by_index);
  const auto verdict = check(*plan, problem);
  EXPECT_TRUE(verdict.has_value()) << to_string(verdict.error());
}

TEST(TerrainLabels, CostAsMuchAsAStar) {
  Rng rng = Rng(81).child("terrain labels");
  for (int i = 0; i < testing::cases(60); ++i) {
    const auto grid = i % 3 == 0 ? rooms(rng, 40) : random_grid(rng, 30);
    const auto ground = ground_of(grid);
    const auto costs = i % 5 == 0 ? nullptr : random_costs(rng, grid.frame);
    Workspace workspace;
    for (int k = 0; k < 25; ++k) {
      Problem problem{ground, any_point(rng, grid.frame), any_point(rng, grid.frame)};
      problem.costs = costs;
      expect_the_cost_of_a_star(problem, workspace, true);
    }
  }
}

TEST(TerrainLabels, OtherGroundAndCostsAreSearchedUntilThatHasCostAsMuch) {
  Rng rng = Rng(82).child("changes");
  const Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 40, 40});
  auto ground = ground_of(grid);
  Workspace workspace;
  Problem problem{ground, {0.5, 0.5}, {39.5, 39.5}};
  problem.costs = random_costs(rng, grid.frame);
  auto changed = *problem.costs;
  for (int x = 5; x < 35; ++x) changed.per_m[{x, 20}] = 9.0F;
  expect_the_cost_of_a_star(problem, workspace, true);
  const auto equal = std::make_shared<const CellCosts>(*problem.costs);
  problem.costs = equal;  // another object, but the same costs
  problem.grid = std::make_shared<const GridMap>(*ground);
  expect_the_cost_of_a_star(problem, workspace, true);
  problem.costs = std::make_shared<const CellCosts>(changed);
  int searched = 0;
  for (int k = 0; k < 100'000; ++k) {
    const auto plan = terrain_labels(problem, {}, {}, workspace);
    ASSERT_TRUE(plan.has_value());
    if (plan->remark.empty()) break;
    EXPECT_NE(plan->remark.find("has changed"), std::string::npos);
    ++searched;
  }
  EXPECT_GT(searched, 0);
  expect_the_cost_of_a_star(problem, workspace, true);
  problem.costs = random_costs(rng, grid.frame);  // altogether different
  expect_the_cost_of_a_star(problem, workspace, true);
}

TEST(TerrainLabels, SayWhyTheyAreSearchedWhereTheyDoNotFit) {
  Rng rng = Rng(83).child("large");
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 200, 120});
  Problem problem{ground_of(grid), {0.5, 0.5}, {199.5, 119.5}};
  problem.costs = random_costs(rng, grid.frame);
  TerrainLabelsOptions small;
  small.hub_memory_mib = 1;
  Workspace workspace;
  const auto plan = terrain_labels(problem, small, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->remark,
            "terrain_a_star answers, since the labels of 200 x 120 cells do not fit into 1 MiB; give more "
            "hub_memory, or a coarser map");
  EXPECT_EQ(plan->cost, terrain_a_star(problem, {}, {}, workspace)->cost);
}

TEST(TerrainLabels, ACancelledBuildLeavesNothing) {
  Rng rng = Rng(84).child("cancelled");
  const Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 40, 40});
  Problem problem{ground_of(grid), {0.5, 0.5}, {39.5, 39.5}};
  problem.costs = random_costs(rng, grid.frame);
  std::stop_source source;
  source.request_stop();
  Budget budget;
  budget.stop = source.get_token();
  Workspace workspace;
  EXPECT_EQ(terrain_labels(problem, {}, budget, workspace).error().code, FaultCode::cancelled);
  expect_the_cost_of_a_star(problem, workspace, true);
}

TEST(DissectionOrder, HoldsEachFreeCellOnceAndCutsFirst) {
  Rng rng = Rng(85).child("order");
  for (int i = 0; i < testing::cases(60); ++i) {
    const auto ground = ground_of(random_grid(rng, 40));
    auto order = hub_labelling::dissection_order(*ground);
    std::vector<std::uint32_t> free;
    for (std::size_t k = 0; k < ground->frame.size(); ++k) {
      const Cell c = ground->frame.cell(k);
      if (!ground->blocked(c)) free.push_back(ground->index(c));
    }
    std::sort(order.begin(), order.end());
    std::sort(free.begin(), free.end());
    EXPECT_EQ(order, free);
  }
  Grid<std::uint8_t> two_rooms(GridFrame{{}, 1.0, 21, 9});
  for (int y = 0; y < 9; ++y) two_rooms[{9, y}] = y == 6 ? 0 : 1;
  const auto ground = ground_of(two_rooms);
  EXPECT_EQ(hub_labelling::dissection_order(*ground).front(), ground->index({9, 6}));  // the door
}

}  // namespace
}  // namespace outrider
