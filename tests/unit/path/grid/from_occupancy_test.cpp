#include "outrider/path/grid/from_occupancy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random_grid.hpp"

namespace outrider {
namespace {

/// Distance between two squares, or infinite; cells outside count as occupied squares.
bool free_by_brute_force(const Grid<std::uint8_t>& occupied, Cell c, double radius_m) {
  const int reach = static_cast<int>(radius_m / occupied.frame.resolution_m) + 2;
  for (int y = c.y - reach; y <= c.y + reach; ++y) {
    for (int x = c.x - reach; x <= c.x + reach; ++x) {
      if (occupied.contains({x, y}) && occupied[{x, y}] == 0) continue;
      const double dx = std::max(std::abs(x - c.x) - 1, 0), dy = std::max(std::abs(y - c.y) - 1, 0);
      const double apart = occupied.frame.resolution_m * std::sqrt(dx * dx + dy * dy);
      if ((x == c.x && y == c.y) || apart < radius_m - 1e-9) return false;
    }
  }
  return true;
}

TEST(Inflated, EqualsBruteForceOverAllSquares) {
  Rng rng = Rng(31).child("inflate");
  for (int i = 0; i < 300; ++i) {
    auto occupied = random_grid(rng, 20);
    occupied.frame.resolution_m = rng.uniform(0.02, 0.2);
    const double cells = i % 3 == 0 ? static_cast<double>(rng.below(5)) : rng.uniform(0.0, 4.0);
    const double radius = cells * occupied.frame.resolution_m;
    const auto blocked = inflated(occupied, radius);
    ASSERT_TRUE(blocked.has_value());
    for (std::size_t c = 0; c < occupied.cells.size(); ++c) {
      ASSERT_EQ(blocked->cells[c] == 0, free_by_brute_force(occupied, occupied.frame.cell(c), radius))
          << "grid " << i << " cell " << c;
    }
  }
}

TEST(Inflated, RefusesNumbersThatMakeNoGrid) {
  const auto grid = drawn({"...", "..."});
  for (const double radius : {-0.1, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_FALSE(inflated(grid, radius).has_value());
  }
  Grid<std::uint8_t> wide(GridFrame{{}, 1.0, 40000, 1});
  EXPECT_FALSE(inflated(wide, 0.1).has_value());
  EXPECT_FALSE(inflated({}, 0.1).has_value());
  EXPECT_TRUE(grid_from_occupancy(grid, 0.0, GridModel::corners).has_value());
}

}  // namespace
}  // namespace outrider
