// Jump point search, with and without an index, against A* on grids that are longer than a word of bits.
#include "outrider/path/grid/jps/jps.hpp"

#include <gtest/gtest.h>

#include "outrider/path/check.hpp"
#include "outrider/path/grid/a_star.hpp"
#include "outrider/path/grid/jps/jps_plus.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

std::shared_ptr<const GridMap> ground_of(const Grid<std::uint8_t>& blocked,
                                         GridModel model = GridModel::cells) {
  return std::make_shared<const GridMap>(*GridMap::of(blocked, model));
}

/// Free ground with blocks of all sizes, single cells among them.
Grid<std::uint8_t> grid_with_blocks(Rng& rng, int width, int height, int blocks) {
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, width, height});
  const auto below = [&](int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); };
  for (int i = 0; i < blocks; ++i) {
    const int size = below(4) == 0 ? 24 : 2;
    const int x0 = below(width), y0 = below(height), w = 1 + below(size), h = 1 + below(size);
    for (int y = y0; y < std::min(height, y0 + h); ++y) {
      for (int x = x0; x < std::min(width, x0 + w); ++x) grid[{x, y}] = 1;
    }
  }
  return grid;
}

void expect_the_answers_of_a_star(const std::shared_ptr<const GridMap>& ground, Rng& rng, int queries,
                                  Workspace& workspace) {
  const GridFrame& frame = ground->frame;
  const auto any = [&] {
    return ground->point({static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.width))),
                          static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.height)))});
  };
  for (int i = 0; i < queries; ++i) {
    const Problem problem{ground, any(), any()};
    const auto expected = a_star(problem, {}, {}, workspace);
    const auto plan = jps(problem, {}, {}, workspace);
    ASSERT_EQ(plan.has_value(), expected.has_value());
    if (!plan) {
      EXPECT_EQ(plan.error().code, expected.error().code);
      EXPECT_EQ(jps_plus(problem, {}, {}, workspace).error().code, expected.error().code);
      continue;
    }
    EXPECT_DOUBLE_EQ(plan->cost, expected->cost);
    EXPECT_LE(plan->counters.expansions, expected->counters.expansions);
    const auto indexed = jps_plus(problem, {}, {}, workspace);
    ASSERT_TRUE(indexed.has_value());
    EXPECT_DOUBLE_EQ(indexed->cost, plan->cost);
    EXPECT_TRUE(check(*indexed, problem).has_value());
    const auto verdict = check(*plan, problem);
    EXPECT_TRUE(verdict.has_value()) << to_string(verdict.error());
  }
}

TEST(Jps, AnswersAsAStarOnGridsLongerThanAWord) {
  Rng rng = Rng(3).child("blocks");
  Workspace workspace;  // one for all grounds: the bits of one must not serve another
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{
           {300, 200}, {63, 64}, {64, 63}, {65, 129}, {1, 400}, {400, 1}, {2, 190}}) {
    for (int i = 0; i < testing::cases(12); ++i) {
      const auto grid =
          grid_with_blocks(rng, width, height,
                           static_cast<int>(rng.below(1 + static_cast<std::uint64_t>(width * height / 60))));
      expect_the_answers_of_a_star(ground_of(grid), rng, 8, workspace);
    }
  }
}

TEST(Jps, AnswersAsAStarOnSpeckledGrids) {
  Rng rng = Rng(4).child("speckles");
  Workspace workspace;
  for (int i = 0; i < testing::cases(60); ++i) {
    expect_the_answers_of_a_star(ground_of(random_grid(rng, 150)), rng, 8, workspace);
  }
}

TEST(Jps, OpenGroundNeedsOneExpansionBeforeTheGoal) {
  const auto ground = ground_of(Grid<std::uint8_t>(GridFrame{{}, 0.5, 700, 300}));
  Workspace workspace;
  for (const Cell goal : {Cell{699, 299}, Cell{0, 299}, Cell{699, 0}, Cell{290, 290}, Cell{5, 1}}) {
    const auto plan = jps({ground, ground->point({0, 0}), ground->point(goal)}, {}, {}, workspace);
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->counters.expansions, 2U);
    EXPECT_LE(plan->vertices.size(), 3U);
    const int diagonal = std::min(goal.x, goal.y), straight = std::max(goal.x, goal.y) - diagonal;
    EXPECT_DOUBLE_EQ(plan->cost, 0.5 * (straight + std::sqrt(2.0) * diagonal));
  }
}

TEST(Jps, PathsGoDiagonallyFirst) {
  const auto ground = ground_of(drawn({"......", "......", "......"}));
  Workspace workspace;
  const auto plan = jps({ground, ground->point({0, 0}), ground->point({5, 2})}, {}, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->vertices, (std::vector<Cell>{{0, 0}, {2, 2}, {5, 2}}));
}

TEST(Jps, AGroundThatTookThePlaceOfAnotherIsSeen) {
  Workspace workspace;
  for (int wall = 0; wall < 40; ++wall) {  // freed and made again, often at the same address
    Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 41, 5});
    for (int y = 0; y < 4; ++y) grid[{wall, wall % 2 == 0 ? y : y + 1}] = wall == 0 ? 0 : 1;
    const auto ground = ground_of(grid);
    const Problem problem{ground, ground->point({0, 2}), ground->point({40, 2})};
    const auto plan = jps(problem, {}, {}, workspace);
    ASSERT_TRUE(plan.has_value());
    EXPECT_DOUBLE_EQ(plan->cost, a_star(problem, {}, {}, workspace)->cost) << wall;
    EXPECT_DOUBLE_EQ(jps_plus(problem, {}, {}, workspace)->cost, plan->cost);
    EXPECT_TRUE(check(*plan, problem).has_value());
  }
}

TEST(Jps, WhatItKeepsDoesNotChangeThePlan) {
  Rng rng = Rng(5).child("kept");
  for (int i = 0; i < testing::cases(20); ++i) {
    const auto ground = ground_of(rooms(rng, 90));
    Workspace kept;
    for (int k = 0; k < 30; ++k) {
      const auto any = [&] {
        return ground->point({static_cast<int>(rng.below(90)), static_cast<int>(rng.below(90))});
      };
      const Problem problem{ground, any(), any()};
      Workspace fresh;
      const auto plan = jps(problem, {}, {}, kept), anew = jps(problem, {}, {}, fresh);
      ASSERT_EQ(plan.has_value(), anew.has_value());
      if (plan) {
        EXPECT_EQ(*plan, *anew);
      }
    }
  }
}

TEST(Jps, MazesNeedNoExpansionInDeadEnds) {
  // A comb: a corridor along the bottom, with teeth that end at the top.
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 201, 60});
  for (int x = 1; x < 201; x += 2) {
    for (int y = 1; y < 60; ++y) grid[{x, y}] = 1;
  }
  const auto ground = ground_of(grid);
  Workspace workspace;
  const auto plan = jps({ground, ground->point({0, 59}), ground->point({200, 59})}, {}, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  EXPECT_DOUBLE_EQ(plan->cost, 59.0 + 200.0 + 59.0);
  EXPECT_LE(plan->counters.generated, 300U);
}

TEST(Jps, CornersAreRefused) {
  const auto ground = ground_of(drawn({"...", "..."}), GridModel::corners);
  Workspace workspace;
  const auto plan = jps({ground, ground->point({0, 0}), ground->point({2, 1})}, {}, {}, workspace);
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error().code, FaultCode::bad_input);
}

TEST(JpsPlus, SidesTooLongForTheIndexAreRefused) {
  Workspace workspace;
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{{32767, 1}, {32768, 1}, {1, 32768}}) {
    const auto ground = ground_of(Grid<std::uint8_t>(GridFrame{{}, 1.0, width, height}));
    const Problem problem{ground, ground->point({0, 0}), ground->point({width - 1, height - 1})};
    const auto plan = jps_plus(problem, {}, {}, workspace);
    ASSERT_EQ(plan.has_value(), std::max(width, height) == 32767);
    if (plan) {
      EXPECT_EQ(plan->cost, 32766.0);
    } else {
      EXPECT_EQ(plan.error().code, FaultCode::bad_input);
    }
    EXPECT_EQ(jps(problem, {}, {}, workspace)->cost, std::max(width, height) - 1.0);
  }
}

}  // namespace
}  // namespace outrider
