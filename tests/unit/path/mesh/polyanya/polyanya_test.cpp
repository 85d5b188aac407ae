#include "outrider/path/mesh/polyanya/polyanya.hpp"

#include <gtest/gtest.h>

#include "outrider/path/check.hpp"
#include "outrider/path/grid/line_of_sight.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using oracle::Blocked;

Problem problem_on(const Blocked& grid, Cell start, Cell goal) {
  const auto ground = std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::corners));
  return {ground, ground->point(start), ground->point(goal)};
}

Cell random_vertex(Rng& rng, const GridFrame& frame) {
  return {static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.width) + 1)),
          static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.height) + 1))};
}

/// Length of the shortest path over the corners of single blocked cells, all pairs tried.
template <class Legal>
double shortest_over_corners(const Blocked& grid, Cell start, Cell goal, Legal legal) {
  std::vector<Cell> vertices{start, goal};
  for (int y = 0; y <= grid.frame.height; ++y) {
    for (int x = 0; x <= grid.frame.width; ++x) {
      const int count = oracle::blocked(grid, x, y) + oracle::blocked(grid, x - 1, y) +
                        oracle::blocked(grid, x, y - 1) + oracle::blocked(grid, x - 1, y - 1);
      if (count == 1) vertices.push_back({x, y});
    }
  }
  std::vector<double> best(vertices.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(vertices.size(), false);
  best[0] = 0.0;
  for (;;) {
    std::size_t next = vertices.size();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (!done[i] && std::isfinite(best[i]) && (next == vertices.size() || best[i] < best[next])) next = i;
    }
    if (next == vertices.size() || next == 1) return best[1];
    done[next] = true;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const double through =
          best[next] + std::hypot(vertices[i].x - vertices[next].x, vertices[i].y - vertices[next].y);
      if (!done[i] && through < best[i] && legal(vertices[next], vertices[i])) best[i] = through;
    }
  }
}
double shortest_over_corners(const Blocked& grid, Cell start, Cell goal) {
  return shortest_over_corners(grid, start, goal,
                               [&](Cell a, Cell b) { return oracle::legal(grid, GridModel::corners, a, b); });
}

/// Noise, smoothed by the majority around each cell: halls with ragged walls.
Blocked cave(Rng& rng, int side) {
  Blocked grid(GridFrame{{}, 1.0, side, side});
  for (std::uint8_t& cell : grid.cells) cell = rng.uniform() < 0.42 ? 1 : 0;
  for (int i = 0; i < 2; ++i) {
    const Blocked before = grid;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        int count = 0;
        for (int k = 0; k < 9; ++k) count += oracle::blocked(before, x + k % 3 - 1, y + k / 3 - 1) ? 1 : 0;
        grid[{x, y}] = count >= 5 ? 1 : 0;
      }
    }
  }
  return grid;
}

/// Blocks, diagonal walls and single cells without order.
Blocked furnished_grid(Rng& rng, int most_side) {
  Blocked grid(random_grid(rng, most_side).frame);
  const auto within = [&](int most) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(most))); };
  const int things = within(8);
  for (int i = 0; i < things; ++i) {
    const int kind = within(3), dx = within(2) * 2 - 1;
    const int w = kind == 0   ? 1 + within(5)
                  : kind == 1 ? 1 + within(7)
                              : 1,
              h = kind == 0 ? 1 + within(5) : w;
    const Cell at{within(grid.frame.width), within(grid.frame.height)};
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        const Cell c{at.x + dx * x, at.y + y};
        if (grid.contains(c) && (kind == 0 || x == y || x == y + 1)) grid[c] = 1;
      }
    }
  }
  return grid;
}

TEST(Polyanya, IsTheShortestPathOverAllCorners) {
  Rng rng = Rng(3).child("furnished");
  Workspace workspace;
  int bent = 0;
  for (int i = 0; i < outrider::testing::cases(2500); ++i) {
    const Blocked grid = i % 3 == 0 ? random_grid(rng, 14) : furnished_grid(rng, 20);
    const Cell start = random_vertex(rng, grid.frame), goal = random_vertex(rng, grid.frame);
    if (!oracle::place(grid, GridModel::corners, start) || !oracle::place(grid, GridModel::corners, goal))
      continue;
    const Problem problem = problem_on(grid, start, goal);
    const auto plan = polyanya(problem, {}, {}, workspace);
    const double least = shortest_over_corners(grid, start, goal);
    ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "grid " << i;
    if (!plan) continue;
    ASSERT_NEAR(plan->cost, least, 1e-9) << "grid " << i;
    ASSERT_EQ(plan->lower_bound, plan->cost);
    const auto verdict = check(*plan, problem);
    ASSERT_TRUE(verdict.has_value()) << "grid " << i << ": " << to_string(verdict.error());
    bent += plan->vertices.size() > 2 ? 1 : 0;
  }
  EXPECT_GT(bent, 300);
}

TEST(Polyanya, IsTheShortestPathInCaves) {
  Rng rng = Rng(4).child("caves");
  Workspace workspace;
  for (int i = 0; i < outrider::testing::cases(20); ++i) {
    const Blocked grid = cave(rng, 40);
    const auto ground = std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::corners));
    for (int k = 0; k < 60; ++k) {
      const Cell start = random_vertex(rng, grid.frame), goal = random_vertex(rng, grid.frame);
      if (start == goal || !ground->place(start) || !ground->place(goal)) continue;
      const auto plan = polyanya({ground, ground->point(start), ground->point(goal)}, {}, {}, workspace);
      const double least =
          shortest_over_corners(grid, start, goal, [&](Cell a, Cell b) { return visible(*ground, a, b); });
      ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "cave " << i << ", query " << k;
      if (plan) {
        ASSERT_NEAR(plan->cost, least, 1e-9) << "cave " << i << ", query " << k;
      }
    }
  }
}

TEST(Polyanya, GoesRoundBothSidesOfPinchesButNotThroughThem) {
  const auto grid = drawn({".....", "..#..", ".#...", "....."});
  const Cell pinch{2, 2};
  Workspace workspace;
  for (const Cell goal : {Cell{1, 3}, Cell{3, 1}, Cell{1, 4}, Cell{4, 1}}) {
    const auto plan = polyanya(problem_on(grid, pinch, goal), {}, {}, workspace);
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->vertices, (std::vector<Cell>{pinch, goal}));
  }
  const auto across = polyanya(problem_on(grid, {1, 3}, {3, 1}), {}, {}, workspace);
  ASSERT_TRUE(across.has_value());
  EXPECT_NEAR(across->cost, shortest_over_corners(grid, {1, 3}, {3, 1}), 1e-9);
  EXPECT_GT(across->cost, 2.9);
}

TEST(Polyanya, RunsAlongWallsWithoutExtraWaypoints) {
  const auto grid = drawn({"#########", ".........", "#.#.#.#.#", "#########"});
  Workspace workspace;
  const auto plan = polyanya(problem_on(grid, {0, 2}, {9, 2}), {}, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->vertices, (std::vector<Cell>{{0, 2}, {9, 2}}));
}

TEST(Polyanya, DecidesExactlyOnVeryLongGrids) {
  GridFrame frame;
  frame.width = 1 << 20;
  frame.height = 4;
  Blocked grid(frame);
  for (int x = 1000; x < frame.width; x += 65537) grid[{x, (x / 65537) % 2 == 0 ? 1 : 2}] = 1;
  const Cell start{0, 1}, goal{frame.width, 3};
  Workspace workspace;
  const Problem problem = problem_on(grid, start, goal);
  const auto plan = polyanya(problem, {}, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  EXPECT_TRUE(check(*plan, problem).has_value());
  const auto back = polyanya(problem_on(grid, goal, start), {}, {}, workspace);
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(plan->cost, back->cost, 1e-9 * plan->cost);
}

TEST(Polyanya, OneWorkspaceServesManyGrounds) {
  Workspace workspace;
  const Problem open = problem_on(drawn({"....", "....", "...."}), {0, 0}, {4, 3});
  const Problem walled = problem_on(drawn({"....", "###.", "...."}), {0, 0}, {0, 3});
  for (int i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(polyanya(open, {}, {}, workspace)->cost, 5.0);
    EXPECT_DOUBLE_EQ(polyanya(walled, {}, {}, workspace)->cost, 1.0 + 2.0 * std::sqrt(10.0));
  }
}

}  // namespace
}  // namespace outrider
