#include "outrider/report/discovery.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double most_steps = 500.0;

/// How many cells of the lattice the origin of `to` lies from that of `from`.
Cell shift(const GridFrame& from, const GridFrame& to) {
  const Vec2 apart = (1.0 / from.resolution_m) * (to.origin - from.origin);
  return {static_cast<int>(std::lround(apart.x)), static_cast<int>(std::lround(apart.y))};
}

void append(std::vector<int>& runs, int value) {
  if (runs.empty() || runs[runs.size() - 2] != value) {
    runs.push_back(value);
    runs.push_back(0);
  }
  ++runs.back();
}

/// A rectangle of cells; nothing while high is below low.
struct Extent {
  Cell low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  Cell high{-1, -1};
};

Extent extent_of_known(const Grid<std::uint8_t>& occupancy) {
  Extent known;
  std::size_t at = 0;
  for (int y = 0; y < occupancy.frame.height; ++y) {
    for (int x = 0; x < occupancy.frame.width; ++x, ++at) {
      if (occupancy.cells[at] == unknown_cell) continue;
      known.low = {std::min(known.low.x, x), std::min(known.low.y, y)};
      known.high = {std::max(known.high.x, x), std::max(known.high.y, y)};
    }
  }
  return known;
}

struct Block {
  Occupancy state = unknown_cell;
  float known_s = std::numeric_limits<float>::infinity();
};

/// Of the cells of a square.
Block summary(const Grid<std::uint8_t>& occupancy, const Grid<float>& known_s, Cell low, Cell high) {
  Block block;
  for (int y = low.y; y < high.y; ++y) {
    for (int x = low.x; x < high.x; ++x) {
      const std::size_t at = occupancy.frame.index({x, y});
      const auto state = static_cast<Occupancy>(occupancy.cells[at]);
      if (state == unknown_cell) continue;
      if (block.state != occupied_cell) block.state = state;
      block.known_s = std::min(block.known_s, known_s.cells[at]);
    }
  }
  return block;
}

}  // namespace

void Discovery::follow(const GridFrame& frame) {
  if (known_s_.frame == frame) return;
  Grid<float> moved(frame, never);
  const GridFrame& old = known_s_.frame;
  const Cell by = old.size() == 0 ? Cell{} : shift(old, frame);
  std::size_t at = 0;
  for (int y = 0; y < old.height; ++y) {
    for (int x = 0; x < old.width; ++x, ++at) {
      const Cell cell{x - by.x, y - by.y};
      if (moved.contains(cell)) moved[cell] = known_s_.cells[at];
    }
  }
  known_s_ = std::move(moved);
}

void Discovery::note(const Grid<std::uint8_t>& occupancy, bool redrawn, std::span<const std::size_t> changed,
                     double time_s) {
  follow(occupancy.frame);
  end_s_ = time_s;
  const auto look = [&](std::size_t cell) {
    if (occupancy.cells[cell] == unknown_cell) return;
    known_s_.cells[cell] = std::min(known_s_.cells[cell], static_cast<float>(time_s));
  };
  if (redrawn) {
    for (std::size_t cell = 0; cell < occupancy.cells.size(); ++cell) look(cell);
  } else {
    for (const std::size_t cell : changed) look(cell);
  }
}

ReportMap Discovery::map(const Grid<std::uint8_t>& occupancy, std::size_t most_cells) const {
  ReportMap drawn;
  const Extent known = extent_of_known(occupancy);
  if (known.high.x < known.low.x || known_s_.frame != occupancy.frame) return drawn;
  const int width = known.high.x - known.low.x + 1;
  const int height = known.high.y - known.low.y + 1;
  int k = 1;
  const auto blocks = [&](int cells) { return (cells + k - 1) / k; };
  while (1.0 * blocks(width) * blocks(height) > static_cast<double>(std::max<std::size_t>(1, most_cells)))
    ++k;
  drawn.origin = occupancy.frame.corner(known.low);
  drawn.cell_m = k * occupancy.frame.resolution_m;
  drawn.columns = blocks(width);
  drawn.rows = blocks(height);
  drawn.step_s = std::max(0.2, end_s_ / most_steps);
  int step = 0;
  for (int row = 0; row < drawn.rows; ++row) {
    for (int column = 0; column < drawn.columns; ++column) {
      const Cell low{known.low.x + k * column, known.low.y + k * row};
      const Cell high{std::min(low.x + k, known.high.x + 1), std::min(low.y + k, known.high.y + 1)};
      const Block block = summary(occupancy, known_s_, low, high);
      if (block.known_s < never) step = static_cast<int>(block.known_s / drawn.step_s);
      append(drawn.state_runs, block.state);
      append(drawn.known_runs, step);
    }
  }
  return drawn;
}

}  // namespace outrider
