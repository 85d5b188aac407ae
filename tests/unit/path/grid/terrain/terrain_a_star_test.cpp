#include "outrider/path/grid/terrain/terrain_a_star.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/path/check.hpp"
#include "outrider/path/grid/dijkstra.hpp"
#include "support/costly_cases.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_costs.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

constexpr double tiny = 1e-9;

struct Weighed {
  Grid<std::uint8_t> blocked;
  Grid<float> costs;
  Problem problem;
  Cell start, goal;
};

Weighed weighed(Rng& rng, Grid<std::uint8_t> blocked) {
  const auto cell = [&] {
    return Cell{static_cast<int>(rng.below(static_cast<std::uint64_t>(blocked.frame.width))),
                static_cast<int>(rng.below(static_cast<std::uint64_t>(blocked.frame.height)))};
  };
  blocked.frame.resolution_m = 0.5;
  Weighed made{blocked, testing::random_costs(rng, blocked.frame), {}, cell(), cell()};
  made.blocked[made.start] = made.blocked[made.goal] = 0;
  const auto ground = std::make_shared<const GridMap>(GridMap::of(made.blocked, GridModel::cells).value());
  made.problem = {ground, ground->point(made.start), ground->point(made.goal)};
  made.problem.costs = std::make_shared<const CellCosts>(CellCosts::of(made.costs).value());
  return made;
}

/// The integral along a leg, by many samples.
double sampled_cost(const Grid<float>& costs, Cell a, Cell b) {
  constexpr int samples = 40000;
  const Vec2 from{a.x + 0.5, a.y + 0.5}, to{b.x + 0.5, b.y + 0.5};
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Vec2 p = from + (i + 0.5) / samples * (to - from);
    sum += double{costs[{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))}]};
  }
  return distance(from, to) * sum / samples;
}

/// The least cost of all paths along the moves, or of straight legs between any cells: over all pairs, by the
/// definition, in cells. Legs are judged by the oracle of grids, and priced by samples or by their two cells.
double least_cost(const Weighed& map, bool any_direction) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t count = map.blocked.cells.size();
  std::vector<double> best(count, infinity);
  std::vector<bool> done(count, false);
  best[map.blocked.frame.index(map.start)] = 0.0;
  for (;;) {
    std::size_t next = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (!done[i] && best[i] < infinity && (next == count || best[i] < best[next])) next = i;
    }
    if (next == count) return infinity;
    const Cell v = map.blocked.frame.cell(next);
    if (v == map.goal) return best[next];
    done[next] = true;
    for (std::size_t i = 0; i < count; ++i) {
      const Cell to = map.blocked.frame.cell(i);
      const bool move = std::abs(to.x - v.x) <= 1 && std::abs(to.y - v.y) <= 1;
      if (done[i] || (!any_direction && !move) || !oracle::place(map.blocked, GridModel::cells, to)) continue;
      if (!oracle::legal(map.blocked, GridModel::cells, v, to)) continue;
      const double mean = 0.5 * (double{map.costs[v]} + double{map.costs[to]});
      const double cost =
          move ? mean * std::hypot(to.x - v.x, to.y - v.y) : cost_of_leg(*map.problem.costs, v, to);
      best[i] = std::min(best[i], best[next] + cost);
    }
  }
}

TEST(CellCosts, ALegCostsItsIntegral) {
  Rng rng = Rng(41).child("legs");
  for (int i = 0; i < testing::costly_cases(300); ++i) {
    const Weighed map = weighed(rng, random_grid(rng, 25));
    const CellCosts& costs = *map.problem.costs;
    const double cost = cost_of_leg(costs, map.start, map.goal);
    EXPECT_NEAR(cost, sampled_cost(map.costs, map.start, map.goal), 2e-3 * cost + 1e-12) << "case " << i;
    EXPECT_NEAR(cost, cost_of_leg(costs, map.goal, map.start), 1e-12 * cost);
  }
}

TEST(CellCosts, WhatIsNoCostIsRefused) {
  const GridFrame frame{{}, 1.0, 3, 2};
  Grid<float> costs(frame, 2.0F);
  EXPECT_EQ(CellCosts::of(costs)->least, 2.0);
  for (const float bad :
       {0.0F, -1.0F, 2e6F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    costs[{1, 1}] = bad;
    const auto refused = CellCosts::of(costs);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().sentence.find("cell (1, 1)"), std::string::npos);
  }
  costs.cells.pop_back();
  EXPECT_NE(CellCosts::of(costs).error().sentence.find("one for each cell"), std::string::npos);
}

TEST(TerrainAStar, IsCheapestAlongTheMoves) {
  Rng rng = Rng(42).child("moves");
  int joined = 0;
  for (int i = 0; i < testing::costly_cases(1000); ++i) {
    const Weighed map = weighed(rng, random_grid(rng, 14));
    Workspace workspace;
    const auto plan = terrain_a_star(map.problem, {}, {}, workspace);
    const double least = least_cost(map, false);
    ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "case " << i;
    if (!plan) continue;
    ++joined;
    ASSERT_NEAR(plan->cost, 0.5 * least, tiny * (1.0 + least)) << "case " << i;
    ASSERT_EQ(plan->lower_bound, plan->cost);
    const auto verdict = check(*plan, map.problem);
    ASSERT_TRUE(verdict.has_value()) << to_string(verdict.error());
  }
  EXPECT_GT(joined, testing::in_full() ? 500 : 10);
}

/// Against straight legs between all pairs of cells, the best that any path of this kind can do.
TEST(TerrainThetaStar, IsNearTheCheapestInAnyDirection) {
  Rng rng = Rng(43).child("any direction");
  double ratios = 0.0, worst = 1.0, along_moves = 0.0;
  int joined = 0;
  for (int i = 0; i < testing::costly_cases(400); ++i) {
    const Weighed map = weighed(rng, random_grid(rng, 14));
    Workspace workspace;
    const auto plan = terrain_theta_star(map.problem, {}, {}, workspace);
    const double least = 0.5 * least_cost(map, true);
    ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "case " << i;
    if (!plan || least == 0.0) continue;
    ++joined;
    ASSERT_GE(plan->cost, least * (1.0 - tiny)) << "case " << i;
    ASSERT_LE(plan->lower_bound, least * (1.0 + tiny)) << "case " << i;
    const auto verdict = check(*plan, map.problem);
    ASSERT_TRUE(verdict.has_value()) << to_string(verdict.error());
    ratios += plan->cost / least;
    worst = std::max(worst, plan->cost / least);
    const double by_moves = terrain_a_star(map.problem, {}, {}, workspace)->cost;
    ASSERT_LE(plan->cost, by_moves * (1.0 + tiny)) << "case " << i;
    along_moves += by_moves / least;
  }
  if (!testing::in_full()) return;
  EXPECT_GT(joined, 200);
  EXPECT_LT(ratios / joined, 1.005);
  EXPECT_LT(worst, 1.15);
  EXPECT_GT(along_moves / joined, 1.02);
  RecordProperty("mean", std::to_string(ratios / joined));
  RecordProperty("worst", std::to_string(worst));
  RecordProperty("along_moves", std::to_string(along_moves / joined));
}

/// A swamp between start and goal: the shortest path goes through, the cheapest round it.
TEST(TerrainAStar, GoesRoundASwamp) {
  const GridFrame frame{{}, 1.0, 9, 9};
  const auto ground =
      std::make_shared<const GridMap>(GridMap::of(Grid<std::uint8_t>(frame), GridModel::cells).value());
  Grid<float> costs(frame, 1.0F);
  for (int y = 1; y < 9; ++y) costs[{4, y}] = 20.0F;
  Problem problem{ground, {0.5, 2.5}, {8.5, 2.5}};
  Workspace workspace;
  EXPECT_EQ(terrain_a_star(problem, {}, {}, workspace)->cost, 8.0);
  problem.costs = std::make_shared<const CellCosts>(CellCosts::of(costs).value());
  const auto along = terrain_a_star(problem, {}, {}, workspace);
  ASSERT_TRUE(along.has_value());
  EXPECT_NEAR(along->cost, 4.0 + 4.0 * std::sqrt(2.0), 1e-12);
  const auto any = terrain_theta_star(problem, {}, {}, workspace);
  ASSERT_TRUE(any.has_value());
  EXPECT_NEAR(any->cost, 2.0 * std::hypot(4.0, 2.0), 1e-12) << "past the end of the swamp";
  Plan cheated = *any;
  cheated.cost *= 0.99;
  EXPECT_FALSE(check(cheated, problem).has_value());
  cheated = *any;
  cheated.weights.by_cell = false;
  EXPECT_TRUE(check(cheated, problem).has_value()) << "on cells of cost 1 the integral is the length";
}

TEST(TerrainAStar, EqualCostsGiveTheShortestPathTimesTheCost) {
  Rng rng = Rng(44).child("equal");
  for (int i = 0; i < 200; ++i) {
    Weighed map = weighed(rng, random_grid(rng, 20));
    Workspace workspace;
    const auto shortest = dijkstra(map.problem, {}, {}, workspace);
    map.problem.costs =
        std::make_shared<const CellCosts>(CellCosts::of(Grid<float>(map.blocked.frame, 2.5F)).value());
    const auto plan = terrain_a_star(map.problem, {}, {}, workspace);
    ASSERT_EQ(plan.has_value(), shortest.has_value());
    if (plan) {
      EXPECT_NEAR(plan->cost, 2.5 * shortest->cost, tiny * (1.0 + plan->cost));
    }
  }
}

TEST(TerrainAStar, CostsOfAnotherGridAreRefused) {
  Rng rng = Rng(45).child("frames");
  Weighed map = weighed(rng, strewn(rng, 6, 5, 0.0));
  GridFrame other = map.blocked.frame;
  other.width = 7;
  map.problem.costs = std::make_shared<const CellCosts>(CellCosts::of(Grid<float>(other, 1.0F)).value());
  Workspace workspace;
  for (const auto& refused :
       {terrain_a_star(map.problem, {}, {}, workspace), terrain_theta_star(map.problem, {}, {}, workspace)}) {
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, FaultCode::bad_input);
    EXPECT_NE(refused.error().sentence.find("7 x 5"), std::string::npos) << refused.error().sentence;
  }
}

}  // namespace
}  // namespace outrider
