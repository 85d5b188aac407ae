#include "outrider/report/discovery.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/world/known_extent.hpp"

namespace outrider {
namespace {

constexpr double most_steps = 500.0;

/// How many cells of the lattice the origin of `from` lies from that of `to`.
Cell shift(const GridFrame& from, const GridFrame& to) {
  const Vec2 apart = (1.0 / to.resolution_m) * (from.origin - to.origin);
  return {static_cast<int>(std::lround(apart.x)), static_cast<int>(std::lround(apart.y))};
}

void append(std::vector<int>& runs, int value) {
  if (runs.empty() || runs[runs.size() - 2] != value) {
    runs.push_back(value);
    runs.push_back(0);
  }
  ++runs.back();
}

struct Block {
  Occupancy state = unknown_cell;
  float known_s = std::numeric_limits<float>::infinity();
};

/// The merged value of the cells of a square.
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
  const GridFrame old = std::exchange(known_s_.frame, frame);
  known_s_.cells = moved_cells(known_s_.cells, old, frame, shift(old, frame), never);
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
  const CellExtent known = known_extent(occupancy);
  if (known.width() == 0 || known_s_.frame != occupancy.frame) return drawn;
  int k = 1;
  const auto blocks = [&](int cells) { return (cells + k - 1) / k; };
  while (1.0 * blocks(known.width()) * blocks(known.height()) >
         std::clamp(static_cast<double>(most_cells), 1.0, static_cast<double>(most_drawn_cells)))
    ++k;
  drawn.origin = occupancy.frame.corner(known.low);
  drawn.cell_m = k * occupancy.frame.resolution_m;
  drawn.columns = blocks(known.width());
  drawn.rows = blocks(known.height());
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
