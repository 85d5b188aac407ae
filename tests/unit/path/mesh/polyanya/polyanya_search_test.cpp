// A workspace that has answered many queries, against lines of sight between all corners.
#include "mesh/polyanya/polyanya_search.hpp"

#include <gtest/gtest.h>

#include "mesh/corner_distances.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using oracle::Blocked;
using polyanya_search::Memory;

int below(Rng& rng, int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); }

/// Halls with ragged walls: blobs strewn over the grid, joined or not.
Blocked halls(Rng& rng, int side) {
  Blocked grid(GridFrame{{}, 1.0, side, side});
  for (std::uint8_t& cell : grid.cells) cell = 1;
  for (int i = 0; i < side; ++i) {
    const Cell at{below(rng, side), below(rng, side)};
    const int width = 1 + below(rng, 7), height = 1 + below(rng, 7);
    for (int k = 0; k < width * height; ++k) {
      const Cell c{at.x + k % width, at.y + k / width};
      if (grid.contains(c)) grid[c] = rng.uniform() < 0.06 ? 1 : 0;
    }
  }
  return grid;
}

Blocked some_grid(Rng& rng, int kind) {
  if (kind % 4 == 0) return mesh_oracle::maze(rng, 7, 1 + below(rng, 3), true);
  if (kind % 4 == 1) return rooms(rng, 30);
  return kind % 4 == 2 ? halls(rng, 36) : strewn(rng, 24, 24, rng.uniform(0.1, 0.5));
}

class WornWorkspaces : public ::testing::Test {
 protected:
  /// Asks for paths between random places of a grid.
  void ask(const Blocked& grid, int queries) {
    const auto ground = std::make_shared<const GridMap>(GridMap::of(grid, GridModel::corners).value());
    const mesh_oracle::CornerDistances lengths(grid, *ground);
    for (int k = 0; k < queries; ++k) {
      const Cell start{below(rng, grid.frame.width + 1), below(rng, grid.frame.height + 1)};
      const Cell goal{below(rng, grid.frame.width + 1), below(rng, grid.frame.height + 1)};
      if (!ground->place(start) || !ground->place(goal)) continue;
      const Problem problem{ground, ground->point(start), ground->point(goal)};
      const auto plan = polyanya(problem, {}, {}, workspace);
      const double least = lengths.between(start, goal);
      ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "query " << k;
      if (!plan) continue;
      ASSERT_NEAR(plan->cost, least, 1e-11 * std::max(1.0, least)) << "query " << k;
      ASSERT_EQ(plan->lower_bound, plan->cost);
      ASSERT_TRUE(check(*plan, problem)) << "query " << k;
      ++answered;
    }
  }
  [[nodiscard]] const Memory& memory() { return workspace.get<Memory>(); }

  Rng rng = Rng(14).child("worn");
  Workspace workspace;
  int answered = 0;
};

TEST_F(WornWorkspaces, FindShortestPaths) {
  int with_landmark = 0, with_legs = 0;
  for (int i = 0; i < outrider::testing::cases(48) && !HasFatalFailure(); ++i) {
    SCOPED_TRACE(i);
    ask(some_grid(rng, i), 400);
    with_landmark += memory().landmark.known() ? 1 : 0;
    with_legs += memory().keeps_legs && memory().legs.bytes() > 0 ? 1 : 0;
  }
  EXPECT_GT(answered, 5000);
  EXPECT_GT(with_landmark, 10);
  EXPECT_GT(with_legs, 20);
}

TEST_F(WornWorkspaces, FindShortestPathsOnGroundsThatChange) {
  int known = 0;
  for (int i = 0; i < outrider::testing::cases(16) && !HasFatalFailure(); ++i) {
    Blocked grid = some_grid(rng, i);
    for (int step = 0; step < 12 && !HasFatalFailure(); ++step) {
      SCOPED_TRACE(::testing::Message() << "grid " << i << ", step " << step);
      ask(grid, step % 3 == 0 ? 250 : 30);
      known += memory().landmark.known() ? 1 : 0;
      for (int k = below(rng, 4); k > 0; --k) {
        const Cell c{below(rng, grid.frame.width), below(rng, grid.frame.height)};
        grid[c] = grid[c] == 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(answered, 5000);
  EXPECT_GT(known, 5);
}

TEST_F(WornWorkspaces, CostTheSameBothWays) {
  const auto ground = std::make_shared<const GridMap>(
      GridMap::of(mesh_oracle::maze(rng, 12, 2, true), GridModel::corners).value());
  for (int k = 0; k < 2000; ++k) {
    const Cell start{below(rng, ground->frame.width + 1), below(rng, ground->frame.height + 1)};
    const Cell goal{below(rng, ground->frame.width + 1), below(rng, ground->frame.height + 1)};
    if (!ground->place(start) || !ground->place(goal)) continue;
    const auto there = polyanya({ground, ground->point(start), ground->point(goal)}, {}, {}, workspace);
    const auto back = polyanya({ground, ground->point(goal), ground->point(start)}, {}, {}, workspace);
    ASSERT_TRUE(there.has_value() && back.has_value());
    ASSERT_NEAR(there->cost, back->cost, 1e-11 * there->cost);
    ASSERT_EQ(there->vertices.front(), start);
    ASSERT_EQ(there->vertices.back(), goal);
  }
  EXPECT_TRUE(memory().landmark.known());
}

}  // namespace
}  // namespace outrider
