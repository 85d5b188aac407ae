// The best blocked flight at a target that cannot be hit: the one that comes nearest to a hit, and what stops
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "outrider/ballistics/shot.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// A flight through the centre of a target that something stops, or that passes something within the margin.
struct BlockedFlight {
  Vec2 position;             ///< of the robot
  Shot shot;                 ///< of the gun
  Impact impact;             ///< its end; a hit, if the flight keeps less than the margin
  double short_m = 0.0;      ///< distance from the ball to the target at its end; 0 for a hit
  std::size_t solid = 0;     ///< what stops it, or what it comes nearest to: index in the FlightSpace
  Vec3 at;                   ///< centre of the ball where it touches that or is nearest to it
  double clearance_m = 0.0;  ///< from that; 0 unless it hits
};

/// Returns the flight that ends nearest to the target, and among those that hit it the one with the most
/// clearance. It flies through the centre of the target, at the pitches of pitch_lattice(), from the cells
/// that are `standable`: from 500 of them or so in a coarser grid, then from those around the best. So it is
/// the best of many flights, not of all. Nothing, if none of the cells is within reach, or `stop` is
/// requested. O(pitches x solids), 600 times.
std::optional<BlockedFlight> best_blocked_flight(const ShotRules& rules, const FlightSpace& space,
                                                 const Target& target, const GridFrame& frame,
                                                 const std::vector<std::uint8_t>& standable,
                                                 const std::stop_token& stop = {});

}  // namespace outrider
