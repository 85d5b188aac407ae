// The widest ways to the ground on which the robot does not fit, and how wide they are.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "outrider/jobs/explore/choose/decide.hpp"

namespace outrider {

/// For each known free cell, the widest way to it from where the robot can drive.
struct WidestWays {
  static constexpr float drivable = std::numeric_limits<float>::infinity();
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// The least clearance of the cells' centres on the way, that of the cell included; `drivable` where the
  /// robot can drive, 0 where no way leads.
  std::vector<float> room_m;
  std::vector<std::uint32_t> before;  ///< the cell before it on the way, or none

  /// Returns the cell with the most room.
  [[nodiscard]] std::uint32_t roomiest(const std::vector<std::uint32_t>& cells) const;
  /// Returns the way to a cell, from the last drivable cell on.
  [[nodiscard]] std::vector<std::uint32_t> way_to(std::uint32_t cell) const;
};

/// Computes the ways. Drivable are the cells that the robot at `from` reaches over cells that are not
/// blocked; the others are taken for the widest way, then the shortest, over free cells whose clearance is
/// at least `least_room_m`. Cells blocked by a touch count as free only if `past_touches` is set. Clearances
/// are cut off as in TraversabilityGrid::clearance_m(). Moves pass no corner.
/// O(n log n + cells beside walls x cells of the disk).
WidestWays widest_ways(const TraversabilityGrid& ground, Vec2 from, bool past_touches, double least_room_m);

/// The narrowest place of a way.
struct Bottleneck {
  Vec2 place;
  double width_m = 0.0;  ///< of the gap there between occupied squares, as the map shows it
};

/// Returns the narrowest place of a way of at least one cell.
Bottleneck bottleneck_of(const TraversabilityGrid& ground, const std::vector<std::uint32_t>& way);

}  // namespace outrider
