// Finds the free cell nearest to a point, and keeps the floods of a decision.
#pragma once

#include <optional>

#include "map/flood.hpp"
#include "outrider/world/nearest_cell.hpp"

namespace outrider {

inline constexpr double snap_m = 0.5;  ///< a robot on blocked ground is led to free ground within this

/// The floods that the workspace keeps: one from the robot, and one for any other use.
struct RobotFlood {
  Flood flood;
};
struct OtherFlood {
  Flood flood;
};

/// The nearest block that is free.
inline std::optional<std::uint32_t> free_block_near(const TraversabilityGrid& ground, Vec2 point) {
  const Grid<std::uint8_t>& blocks = ground.blocks();
  const auto block = nearest_cell(blocks.frame, point, snap_m,
                                  [&](Cell c) { return blocks[c] != TraversabilityGrid::no_block; });
  if (!block) return std::nullopt;
  return static_cast<std::uint32_t>(blocks.frame.index(*block));
}

}  // namespace outrider
