#include "outrider/path/hubs/octile/octile_labels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/path/check.hpp"
#include "outrider/path/grid/dijkstra.hpp"
#include "support/costly_cases.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using oracle::Blocked;

std::shared_ptr<const GridMap> ground_of(const Blocked& grid) {
  return std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::cells));
}

Cell random_cell(Rng& rng, const GridFrame& frame) {
  return {static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.width))),
          static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.height)))};
}

Problem between(const std::shared_ptr<const GridMap>& ground, Cell start, Cell goal) {
  return {ground, ground->point(start), ground->point(goal)};
}

/// The same cost as dijkstra, a legal path, or the same refusal. Returns the plan.
Outcome<Plan> expect_as_dijkstra(const Problem& problem, const OctileLabelsOptions& options,
                                 Workspace& workspace) {
  auto plan = octile_labels(problem, options, {}, workspace);
  const auto truth = dijkstra(problem, {}, {}, workspace);
  EXPECT_EQ(plan.has_value(), truth.has_value());
  if (!plan || !truth) {
    EXPECT_EQ(plan ? "" : to_string(plan.error()), truth ? "" : to_string(truth.error()));
    return plan;
  }
  EXPECT_EQ(plan->cost, truth->cost);
  EXPECT_EQ(plan->lower_bound, plan->cost);
  const auto verdict = check(*plan, problem);
  EXPECT_TRUE(verdict.has_value()) << to_string(verdict.error());
  return plan;
}

bool by_index(const Plan& plan) { return plan.counters.generated == 0; }

TEST(OctileLabels, AreTheShortestPathsOverAllVertices) {
  Rng rng = Rng(31).child("brute force");
  Workspace workspace;
  int joined = 0;
  for (int i = 0; i < outrider::testing::cases(1500); ++i) {
    const Blocked grid = random_grid(rng, 9);
    const auto ground = ground_of(grid);
    for (int k = 0; k < 4; ++k) {
      const Cell start = random_cell(rng, grid.frame), goal = random_cell(rng, grid.frame);
      if (!ground->place(start) || !ground->place(goal)) continue;
      const auto plan = octile_labels(between(ground, start, goal), {}, {}, workspace);
      const double least = oracle::shortest(grid, GridModel::cells, start, goal, false);
      ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "grid " << i;
      if (!plan) continue;
      ASSERT_NEAR(plan->cost, least, 1e-9) << "grid " << i;
      ASSERT_TRUE(check(*plan, between(ground, start, goal)));
      ASSERT_TRUE(by_index(*plan));
      ++joined;
    }
  }
  EXPECT_GT(joined, 1500);
}

TEST(OctileLabels, AgreeWithDijkstraForAllPairsOfCells) {
  Rng rng = Rng(32).child("all pairs");
  Workspace workspace;
  std::size_t bent = 0, closed = 0;
  for (int i = 0; i < outrider::testing::costly_cases(50); ++i) {
    const auto ground = ground_of(i % 3 == 0 ? rooms(rng, 12) : random_grid(rng, 11));
    std::vector<Cell> places;
    for (std::uint32_t v = 0; v < ground->marks.size(); ++v) {
      if (ground->place(ground->at(v))) places.push_back(ground->at(v));
    }
    for (const Cell start : places) {
      for (const Cell goal : places) {
        const auto plan = expect_as_dijkstra(between(ground, start, goal), {}, workspace);
        ASSERT_FALSE(HasFailure()) << "grid " << i << ": " << start.x << "," << start.y << " to " << goal.x
                                   << "," << goal.y;
        if (!plan) ++closed;
        if (plan && plan->vertices.size() > 3) ++bent;
      }
    }
  }
  if (!outrider::testing::in_full()) return;
  EXPECT_GT(bent, 15'000U);
  EXPECT_GT(closed, 15'000U);
}

TEST(OctileLabels, AgreeWithDijkstraOnRoomsAndStrewnCells) {
  Rng rng = Rng(33).child("rooms");
  Workspace workspace;
  int bent = 0;
  for (int i = 0; i < outrider::testing::costly_cases(30); ++i) {
    const int side = 20 + static_cast<int>(rng.below(70));
    const Blocked grid = i % 2 == 0 ? rooms(rng, side) : strewn(rng, side, 35, rng.uniform(0.02, 0.45));
    const auto ground = ground_of(grid);
    for (int k = 0; k < 80; ++k) {
      const Cell start = random_cell(rng, grid.frame), goal = random_cell(rng, grid.frame);
      const auto plan = expect_as_dijkstra(between(ground, start, goal), {}, workspace);
      ASSERT_FALSE(HasFailure()) << "grid " << i << ", query " << k;
      bent += plan && plan->vertices.size() > 3 ? 1 : 0;
    }
  }
  if (!outrider::testing::in_full()) return;
  EXPECT_GT(bent, 500);
}

TEST(OctileLabels, StartAtTheGoalAndAnEnclosedGoal) {
  const auto ground = ground_of(drawn({".....", ".###.", ".#.#.", ".###.", "....."}));
  Workspace workspace;
  const auto still = octile_labels(between(ground, {0, 0}, {0, 0}), {}, {}, workspace);
  ASSERT_TRUE(still);
  EXPECT_EQ(still->cost, 0.0);
  EXPECT_EQ(still->vertices, std::vector<Cell>{Cell{}});
  EXPECT_EQ(octile_labels(between(ground, {0, 0}, {2, 2}), {}, {}, workspace).error().code,
            FaultCode::no_path);
  const auto round = octile_labels(between(ground, {0, 0}, {4, 4}), {}, {}, workspace);
  ASSERT_TRUE(round);
  EXPECT_EQ(round->vertices, (std::vector<Cell>{{0, 0}, {4, 0}, {4, 4}}));
}

TEST(OctileLabels, SearchAmongLandmarksWhereLabelsDoNotFit) {
  Rng rng = Rng(34).child("small memory");
  const Blocked grid = strewn(rng, 120, 120, 0.1);
  const auto ground = ground_of(grid);
  OctileLabelsOptions small;
  small.hub_memory_mib = 2;
  Workspace narrow, wide;
  int searched = 0;
  for (int k = 0; k < outrider::testing::costly_cases(300); ++k) {
    const Problem problem = between(ground, random_cell(rng, grid.frame), random_cell(rng, grid.frame));
    const auto a = expect_as_dijkstra(problem, small, narrow), b = octile_labels(problem, {}, {}, wide);
    ASSERT_FALSE(HasFailure()) << "query " << k;
    if (!a || !b) continue;
    ASSERT_TRUE(by_index(*a));
    ASSERT_EQ(b->counters.expansions, 1U) << "not by labels";
    searched += a->counters.expansions > 1 ? 1 : 0;
  }
  EXPECT_GT(searched, outrider::testing::costly_cases(30));
}

TEST(OctileLabels, SearchAmongLandmarksOnChangedGrounds) {
  Rng rng = Rng(38).child("changes");
  auto ground = ground_of(strewn(rng, 120, 120, 0.1));
  OctileLabelsOptions small;
  small.hub_memory_mib = 2;
  Workspace workspace;
  int searched = 0;
  for (int step = 0; step < outrider::testing::cases(12); ++step) {
    for (int k = 0; k < 25; ++k) {
      const Problem problem =
          between(ground, random_cell(rng, ground->frame), random_cell(rng, ground->frame));
      const auto plan = expect_as_dijkstra(problem, small, workspace);
      ASSERT_FALSE(HasFailure()) << "step " << step << ", query " << k;
      searched += plan && by_index(*plan) && plan->counters.expansions > 1 ? 1 : 0;
    }
    const Cell low{static_cast<int>(rng.below(118)), static_cast<int>(rng.below(118))};
    ground = std::make_shared<const GridMap>(ground->with({{low, 2, 2, rng.below(3) != 0}}).value());
  }
  EXPECT_GT(searched, 50);
}

TEST(OctileLabels, LeaveItToJumpPointSearchWhereTheHubsDoNotFit) {
  Rng rng = Rng(35).child("no memory");
  const auto strewn_ground = ground_of(strewn(rng, 150, 150, 0.25));
  const auto long_ground = ground_of(strewn(rng, 40'000, 3, 0.02));
  OctileLabelsOptions options;
  options.hub_memory_mib = 1;
  Workspace workspace;
  for (const auto& ground : {strewn_ground, long_ground}) {
    for (int k = 0; k < 40; ++k) {
      const auto plan = expect_as_dijkstra(
          between(ground, random_cell(rng, ground->frame), random_cell(rng, ground->frame)), options,
          workspace);
      ASSERT_FALSE(HasFailure()) << "query " << k;
      EXPECT_FALSE(plan && plan->vertices.size() > 1 && by_index(*plan));
    }
  }
}

TEST(OctileLabels, AreMadeAnewForAnotherGround) {
  Rng rng = Rng(36).child("grounds");
  Workspace workspace;
  const auto one = ground_of(rooms(rng, 30)), other = ground_of(rooms(rng, 30));
  int bent = 0;
  for (int k = 0; k < 40; ++k) {
    const auto& ground = k % 2 == 0 ? one : other;
    const auto plan = expect_as_dijkstra(
        between(ground, random_cell(rng, ground->frame), random_cell(rng, ground->frame)), {}, workspace);
    ASSERT_FALSE(HasFailure()) << "query " << k;
    bent += plan && plan->vertices.size() > 3 ? 1 : 0;
  }
  EXPECT_GT(bent, 20);
}

TEST(OctileLabels, AreTheSameInEveryWorkspace) {
  Rng rng = Rng(37).child("twice");
  const auto ground = ground_of(rooms(rng, 60));
  Workspace one, other;
  for (int k = 0; k < 200; ++k) {
    const Problem problem = between(ground, random_cell(rng, ground->frame), random_cell(rng, ground->frame));
    const auto a = octile_labels(problem, {}, {}, one), b = octile_labels(problem, {}, {}, other);
    ASSERT_EQ(a.has_value(), b.has_value());
    ASSERT_TRUE(!a || *a == *b) << "query " << k;
  }
}

}  // namespace
}  // namespace outrider
