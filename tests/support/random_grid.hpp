// Small seeded grids for tests.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Between 1 and `most_side` cells a side, each blocked with a chance drawn from [0, 0.6).
inline Grid<std::uint8_t> random_grid(Rng& rng, int most_side) {
  GridFrame frame;
  frame.width = 1 + static_cast<int>(rng.below(static_cast<std::uint64_t>(most_side)));
  frame.height = 1 + static_cast<int>(rng.below(static_cast<std::uint64_t>(most_side)));
  const double density = rng.uniform(0.0, 0.6);
  Grid<std::uint8_t> grid(frame);
  for (std::uint8_t& cell : grid.cells) cell = rng.uniform() < density ? 1 : 0;
  return grid;
}

/// So many cells, each blocked with that chance.
inline Grid<std::uint8_t> strewn(Rng& rng, int width, int height, double density) {
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, width, height});
  for (std::uint8_t& cell : grid.cells) cell = rng.uniform() < density ? 1 : 0;
  return grid;
}

/// Walls all over, with gaps, and pillars that may touch them at corners.
inline Grid<std::uint8_t> rooms(Rng& rng, int side) {
  Grid<std::uint8_t> grid = strewn(rng, side, side, 0.03);
  const int pitch = 4 + static_cast<int>(rng.below(5));
  for (int i = pitch; i < side; i += pitch) {
    for (int k = 0; k < side; ++k) {
      if (rng.below(5) != 0) grid[{i, k}] = 1;
      if (rng.below(5) != 0) grid[{k, i}] = 1;
    }
  }
  return grid;
}

/// A grid as it looks on the page: first row on top, '#' blocked.
inline Grid<std::uint8_t> drawn(const std::vector<std::string>& rows) {
  GridFrame frame;
  frame.width = static_cast<int>(rows.front().size());
  frame.height = static_cast<int>(rows.size());
  Grid<std::uint8_t> grid(frame);
  for (int y = 0; y < frame.height; ++y) {
    const std::string& row = rows[static_cast<std::size_t>(frame.height - 1 - y)];
    for (int x = 0; x < frame.width; ++x) grid[{x, y}] = row[static_cast<std::size_t>(x)] == '#' ? 1 : 0;
  }
  return grid;
}

}  // namespace outrider
