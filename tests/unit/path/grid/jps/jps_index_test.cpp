// The index of jps_plus against runs walked cell by cell, by the definition of a forced turn.
#include "grid/jps/jps_index.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "support/random_grid.hpp"

namespace outrider::jump {
namespace {

bool free(const Grid<std::uint8_t>& grid, Cell c) { return grid.contains(c) && grid[c] == 0; }

bool legal(const Grid<std::uint8_t>& grid, Cell c, Cell d) {
  return free(grid, c) && free(grid, {c.x + d.x, c.y + d.y}) && free(grid, {c.x + d.x, c.y}) &&
         free(grid, {c.x, c.y + d.y});
}

/// Returns true if at c, reached along the straight d, a blocked cell behind to a side forces a turn to that
/// side.
bool forced(const Grid<std::uint8_t>& grid, Cell c, Cell d) {
  for (const int s : {-1, 1}) {
    const Cell side{s * d.y, s * d.x};
    const Cell beside{c.x + side.x, c.y + side.y};
    if (free(grid, beside) && !free(grid, {beside.x - d.x, beside.y - d.y})) return true;
  }
  return false;
}

/// The distance as jps_index.hpp defines it, for any of the eight moves.
int walked(const Grid<std::uint8_t>& grid, Cell c, Cell d) {
  for (int steps = 0;; ++steps) {
    if (!legal(grid, c, d)) return -steps;
    c = {c.x + d.x, c.y + d.y};
    const bool diagonal = d.x != 0 && d.y != 0;
    if (!diagonal && forced(grid, c, d)) return steps + 1;
    if (diagonal && (walked(grid, c, {d.x, 0}) > 0 || walked(grid, c, {0, d.y}) > 0)) return steps + 1;
  }
}

TEST(JpsIndex, DistancesAreThoseOfWalkedRuns) {
  Rng rng = Rng(5).child("index");
  for (int i = 0; i < 300; ++i) {
    const auto grid = random_grid(rng, 24);
    const auto ground = GridMap::of(grid, GridModel::cells);
    ASSERT_TRUE(ground.has_value());
    const auto distances = distances_of(*ground);
    for (int y = 0; y < grid.frame.height; ++y) {
      for (int x = 0; x < grid.frame.width; ++x) {
        if (!free(grid, {x, y})) continue;
        for (unsigned m = 0; m < 8; ++m) {
          ASSERT_EQ(distances[ground->index({x, y})][m], walked(grid, {x, y}, grid_moves[m]))
              << "cell " << x << ", " << y << " move " << m << " of grid " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace outrider::jump
