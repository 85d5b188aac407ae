#include "outrider/path/hubs/any_angle/hub_labels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/path/check.hpp"
#include "outrider/path/grid/line_of_sight.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"
#include "support/costly_cases.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using oracle::Blocked;

std::shared_ptr<const GridMap> ground_of(const Blocked& grid) {
  return std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::corners));
}

Cell random_vertex(Rng& rng, const GridFrame& frame) {
  return {static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.width) + 1)),
          static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.height) + 1))};
}

/// The same cost as polyanya, a legal path, or the same refusal.
void expect_as_polyanya(const Problem& problem, const HubLabelsOptions& options, Workspace& workspace,
                        int& bent) {
  const auto plan = hub_labels(problem, options, {}, workspace);
  const auto truth = polyanya(problem, {}, {}, workspace);
  ASSERT_EQ(plan.has_value(), truth.has_value());
  if (!plan) {
    ASSERT_EQ(to_string(plan.error()), to_string(truth.error()));
    return;
  }
  ASSERT_NEAR(plan->cost, truth->cost, 1e-9 * std::max(1.0, truth->cost));
  ASSERT_EQ(plan->lower_bound, plan->cost);
  const auto verdict = check(*plan, problem);
  ASSERT_TRUE(verdict.has_value()) << to_string(verdict.error());
  bent += plan->vertices.size() > 2 ? 1 : 0;
}

TEST(HubLabels, AreTheShortestPathOverAllVertices) {
  Rng rng = Rng(21).child("brute force");
  Workspace workspace;
  int joined = 0;
  for (int i = 0; i < outrider::testing::cases(800); ++i) {
    const Blocked grid = random_grid(rng, 8);
    const auto ground = ground_of(grid);
    for (int k = 0; k < 4; ++k) {
      const Cell start = random_vertex(rng, grid.frame), goal = random_vertex(rng, grid.frame);
      if (!ground->place(start) || !ground->place(goal)) continue;
      const auto plan = hub_labels({ground, ground->point(start), ground->point(goal)}, {}, {}, workspace);
      const double least = oracle::shortest(grid, GridModel::corners, start, goal, true);
      ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "grid " << i;
      if (!plan) continue;
      ASSERT_NEAR(plan->cost, least, 1e-9) << "grid " << i;
      ++joined;
    }
  }
  EXPECT_GT(joined, 800);
}

TEST(HubLabels, AgreeWithPolyanya) {
  Rng rng = Rng(22).child("polyanya");
  Workspace workspace;
  int bent = 0;
  for (int i = 0; i < outrider::testing::cases(24); ++i) {
    const int side = 20 + static_cast<int>(rng.below(35));
    const Blocked grid = i % 2 == 0 ? rooms(rng, side) : strewn(rng, side, 35, rng.uniform(0.02, 0.45));
    const auto ground = ground_of(grid);
    for (int k = 0; k < 60; ++k) {
      const Cell start = random_vertex(rng, grid.frame), goal = random_vertex(rng, grid.frame);
      expect_as_polyanya({ground, ground->point(start), ground->point(goal)}, {}, workspace, bent);
      ASSERT_FALSE(HasFatalFailure()) << "grid " << i << ", query " << k;
    }
  }
  EXPECT_GT(bent, 400);
}

TEST(HubLabels, GoRoundBothSidesOfPinchesButNotThroughThem) {
  const auto ground = ground_of(drawn({".....", "..#..", ".#...", "....."}));
  Workspace workspace;
  int bent = 0;
  for (int y = 0; y <= 4; ++y) {
    for (int x = 0; x <= 5; ++x) {
      for (int k = 0; k < 30; ++k) {
        const Cell goal{k % 6, k / 6};
        expect_as_polyanya({ground, ground->point({x, y}), ground->point(goal)}, {}, workspace, bent);
        ASSERT_FALSE(HasFatalFailure()) << x << "," << y << " to " << goal.x << "," << goal.y;
      }
    }
  }
  EXPECT_GT(bent, 200);
}

TEST(HubLabels, SearchAmongLandmarksWhereLabelsDoNotFit) {
  Rng rng = Rng(23).child("small memory");
  const Blocked grid = strewn(rng, 90, 90, 0.1);
  const auto ground = ground_of(grid);
  HubLabelsOptions small, large;
  small.hub_memory_mib = 1;
  large.hub_memory_mib = 512;
  Workspace narrow, wide;
  int searched = 0, bent = 0;
  for (int k = 0; k < outrider::testing::costly_cases(100); ++k) {
    const Problem problem{ground, ground->point(random_vertex(rng, grid.frame)),
                          ground->point(random_vertex(rng, grid.frame))};
    expect_as_polyanya(problem, small, narrow, bent);
    ASSERT_FALSE(HasFatalFailure()) << "query " << k;
    const auto a = hub_labels(problem, small, {}, narrow), b = hub_labels(problem, large, {}, wide);
    if (!a || !b) continue;
    ASSERT_EQ(a->counters.generated, 0U) << "not by landmarks";
    ASSERT_EQ(b->counters.expansions, 1U) << "not by labels";
    searched += a->counters.expansions > 1 ? 1 : 0;
  }
  EXPECT_GT(searched, outrider::testing::costly_cases(10));
}

TEST(HubLabels, SearchAmongLandmarksOnChangedGrounds) {
  Rng rng = Rng(26).child("changes");
  auto ground = ground_of(strewn(rng, 120, 120, 0.1));
  HubLabelsOptions small;
  small.hub_memory_mib = 2;
  Workspace workspace;
  int bent = 0, searched = 0;
  for (int step = 0; step < outrider::testing::cases(12); ++step) {
    for (int k = 0; k < 25; ++k) {
      const Problem problem{ground, ground->point(random_vertex(rng, ground->frame)),
                            ground->point(random_vertex(rng, ground->frame))};
      Workspace anew;
      const auto plan = hub_labels(problem, small, {}, workspace);
      const auto truth = polyanya(problem, {}, {}, anew);
      ASSERT_EQ(plan.has_value(), truth.has_value()) << "step " << step << ", query " << k;
      if (!plan) continue;
      ASSERT_NEAR(plan->cost, truth->cost, 1e-9 * std::max(1.0, truth->cost))
          << "step " << step << ", query " << k;
      ASSERT_TRUE(check(*plan, problem));
      bent += plan->vertices.size() > 2 ? 1 : 0;
      searched += plan->counters.generated == 0 && plan->counters.expansions > 1 ? 1 : 0;
    }
    const Cell low{static_cast<int>(rng.below(118)), static_cast<int>(rng.below(118))};
    ground = std::make_shared<const GridMap>(ground->with({{low, 2, 2, rng.below(3) != 0}}).value());
  }
  EXPECT_GT(bent, 100);
  EXPECT_GT(searched, 50);
}

TEST(HubLabels, LeaveItToPolyanyaWhereTheHubsDoNotFit) {
  Rng rng = Rng(24).child("no memory");
  const auto ground = ground_of(strewn(rng, 150, 150, 0.25));
  HubLabelsOptions options;
  options.hub_memory_mib = 1;
  Workspace workspace;
  int bent = 0;
  for (int k = 0; k < 50; ++k) {
    const Problem problem{ground, ground->point(random_vertex(rng, ground->frame)),
                          ground->point(random_vertex(rng, ground->frame))};
    expect_as_polyanya(problem, options, workspace, bent);
    ASSERT_FALSE(HasFatalFailure()) << "query " << k;
  }
  EXPECT_GT(bent, 20);
}

TEST(HubLabels, AreMadeAnewForAnotherGround) {
  Rng rng = Rng(25).child("grounds");
  Workspace workspace;
  const auto one = ground_of(rooms(rng, 30)), other = ground_of(rooms(rng, 30));
  int bent = 0;
  for (int k = 0; k < 40; ++k) {
    const auto& ground = k % 2 == 0 ? one : other;
    const Problem problem{ground, ground->point(random_vertex(rng, ground->frame)),
                          ground->point(random_vertex(rng, ground->frame))};
    expect_as_polyanya(problem, {}, workspace, bent);
    ASSERT_FALSE(HasFatalFailure()) << "query " << k;
  }
}

}  // namespace
}  // namespace outrider
