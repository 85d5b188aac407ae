#include "mesh/polyanya/forced_turns.hpp"

#include <gtest/gtest.h>

#include "mesh/corner_distances.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider::polyanya_search {
namespace {

using oracle::Blocked;

/// Checks each forced turn of a grid against all turns to which it is said to be on the way; returns how
/// many.
int expect_forced(const Blocked& grid) {
  const GridMap ground = GridMap::of(grid, GridModel::corners).value();
  const NavigationMesh mesh = navigation_mesh(ground);
  const mesh_oracle::CornerDistances lengths(grid, ground);
  ForcedTurns forced;
  forced.find(mesh);
  int checked = 0;
  for (std::uint32_t turn = 0; turn < mesh.turns.size(); ++turn) {
    const ForcedTurn& next = forced.after(turn);
    for (const NavigationMesh::Turn& other : mesh.turns) {
      bool beyond = false;
      for (std::uint32_t i = other.around; i < other.around + other.polygons; ++i)
        beyond = beyond || next.on_way_to(mesh.order[mesh.around[i].polygon]);
      const Cell at = mesh.turns[turn].at;
      const double whole = beyond ? lengths.between(at, other.at) : 0.0;
      if (!beyond || !std::isfinite(whole)) continue;  // polygons of another component have other orders
      const Cell over = mesh.turns[next.turn].at;
      EXPECT_NEAR(whole, std::hypot(over.x - at.x, over.y - at.y) + lengths.between(over, other.at), 1e-9)
          << "from (" << at.x << ", " << at.y << ") over (" << over.x << ", " << over.y << ") to ("
          << other.at.x << ", " << other.at.y << ")";
      ++checked;
    }
  }
  return checked;
}

TEST(ForcedTurns, AreOnTheShortestPathsThroughMazes) {
  Rng rng = Rng(8).child("mazes");
  int checked = 0;
  for (int i = 0; i < outrider::testing::cases(40) && !::testing::Test::HasFailure(); ++i)
    checked += expect_forced(mesh_oracle::maze(rng, 6, 1 + i % 4, i % 3 == 0));
  EXPECT_GT(checked, 5000);
}

TEST(ForcedTurns, AreOnTheShortestPathsOnRandomGrids) {
  Rng rng = Rng(9).child("grids");
  int checked = 0;
  for (int i = 0; i < outrider::testing::cases(1500) && !::testing::Test::HasFailure(); ++i)
    checked += expect_forced(i % 4 == 0 ? rooms(rng, 14) : random_grid(rng, 14));
  EXPECT_GT(checked, 5000);
}

TEST(ForcedTurns, LeadFromAnyCornerOfTheGrid) {
  Rng rng = Rng(10).child("corners");
  int checked = 0;
  for (int i = 0; i < outrider::testing::cases(60); ++i) {
    const Blocked grid = mesh_oracle::maze(rng, 4, 1 + i % 4, i % 3 == 0);
    const GridMap ground = GridMap::of(grid, GridModel::corners).value();
    const NavigationMesh mesh = navigation_mesh(ground);
    const mesh_oracle::CornerDistances lengths(grid, ground);
    ForcedTurns forced;
    forced.find(mesh);
    for (int k = 0; k < 60; ++k) {
      const auto below = [&](int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); };
      const Cell cell{below(grid.frame.width), below(grid.frame.height)};
      const Cell corner{cell.x + below(2), cell.y + below(2)};
      if (ground.blocked(cell) || ground.pinch(corner)) continue;
      std::vector<std::uint32_t> around;
      mesh.polygons_at(corner, cell, ground.frame, around);
      const std::uint32_t first = *std::min_element(
          around.begin(), around.end(), [&](auto a, auto b) { return mesh.order[a] < mesh.order[b]; });
      const ForcedTurn next = forced.from(mesh, corner, first);
      for (int y = 0; y < grid.frame.height; ++y) {
        const Cell target{below(grid.frame.width), y};
        if (ground.blocked(target) ||
            !next.on_way_to(mesh.order[mesh.polygon_of[ground.frame.index(target)]]))
          continue;
        const Cell over = mesh.turns[next.turn].at;
        std::vector<std::uint32_t> at_target;
        mesh.polygons_at(target, target, ground.frame, at_target);
        if (!std::all_of(at_target.begin(), at_target.end(),
                         [&](std::uint32_t p) { return next.on_way_to(mesh.order[p]); })) {
          continue;
        }
        ASSERT_NEAR(lengths.between(corner, target),
                    std::hypot(over.x - corner.x, over.y - corner.y) + lengths.between(over, target), 1e-9);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 3000);
}

}  // namespace
}  // namespace outrider::polyanya_search
