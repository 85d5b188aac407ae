// Finds the free cell nearest to a point, and keeps the floods of a decision.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "flood.hpp"

namespace outrider {

inline constexpr double snap_m = 0.5;  ///< a robot on blocked ground is led to free ground within this

/// Kept in the workspace: the flood from the robot, and one for whatever else.
struct RobotFlood {
  Flood flood;
};
struct OtherFlood {
  Flood flood;
};

/// The cell of a grid nearest to a point within snap_m for which `good(cell)`; of two the first by rows.
template <class Good>
std::optional<Cell> nearest_cell(const GridFrame& frame, Vec2 point, Good good) {
  const Cell middle = frame.cell_at(point);
  const int reach = static_cast<int>(snap_m / frame.resolution_m) + 1;
  std::optional<Cell> best;
  double least = snap_m;
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const Cell cell{x, y};
      if (!frame.contains(cell) || !good(cell)) continue;
      const double away = cell == middle ? 0.0 : distance(frame.centre(cell), point);
      if (away < least || (away == least && !best)) {
        least = away;
        best = cell;
      }
    }
  }
  return best;
}

/// The nearest block that is free.
inline std::optional<std::uint32_t> free_block_near(const TraversabilityGrid& ground, Vec2 point) {
  const Grid<std::uint8_t>& blocks = ground.blocks();
  const auto block =
      nearest_cell(blocks.frame, point, [&](Cell c) { return blocks[c] != TraversabilityGrid::no_block; });
  if (!block) return std::nullopt;
  return static_cast<std::uint32_t>(blocks.frame.index(*block));
}

}  // namespace outrider
