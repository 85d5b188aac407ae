// Firing regions: the places from which a robot can hit a target.
//
// The decision is made for every place of a grid, over a lattice of pitches and over aim points on the
// target. Pitch and aim point determine the speed. A shot counts if the ball, with the margin around it,
// reaches the target before it touches anything else. Results are exact up to the contact tolerance
// (contact.hpp).
//
// The search is fast for two reasons. A sweep along the grid rows finds the few blockers of each place
// (blocker.hpp). And a blocker is approximated by a rectangle in the plane of the flight unless that is too
// coarse (sight.hpp).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <stop_token>
#include <vector>

#include "outrider/ballistics/shot.hpp"
#include "outrider/world/grid_part.hpp"

namespace outrider {

/// Returns the pitches that are tried, rad, ascending: from the lowest to the highest in equal steps of at
/// most `pitch_step_rad`, but at most 255 pitches.
std::vector<double> pitch_lattice(const ShotRules& rules);

/// The places from which a target can be hit, with one shot for each.
struct FiringRegion {
  static constexpr std::uint8_t no_shot = 255;

  GridPart<std::uint8_t> pitch{no_shot};  ///< by cell: index in the pitch lattice, or no_shot
  /// For each cell, error_ratio() of that shot (shot.hpp); infinite if there is none.
  GridPart<float> error_ratio{std::numeric_limits<float>::infinity()};
  std::size_t places = 0;                 ///< number of standable cells
  std::size_t in_range = 0;               ///< number of these within range, ignoring obstacles
  std::size_t hits = 0;                   ///< number of these with a shot
  std::vector<std::uint32_t> blocked_by;  ///< by solid: number of places at which it stops the flattest shot
};

/// Finds all places that keep the standoff distance from which a shot at its centre hits. The shot is
/// the flattest one with an error_ratio of at most 0.7, otherwise the one with the least error_ratio.
/// `standable` is 1 in cells where the robot may stand. If `stop` is requested, no more places are tried, and
/// the result must not be used. O(places in range x blockers in the line of sight); thread-safe for const
/// arguments.
FiringRegion firing_region(const ShotRules& rules, const FlightSpace& space, const Target& target,
                           const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                           const std::stop_token& stop = {});

/// The shots that were tried before a target is called unreachable.
struct Exhausted {
  std::size_t places = 0;     ///< number of standable cells within range
  std::uint64_t flights = 0;  ///< flights decided; none hits with the margin, except that of `found`
  std::vector<std::uint64_t>
      blocked_by;  ///< by solid: number of flights stopped; a flight stopped by several solids counts once
  std::optional<std::size_t> found;  ///< the cell with a hit at which the search ended
  Shot shot;                         ///< the hit from that cell
};

/// Searches a shot like firing_region(), but with aim points at most `aim_step_m` apart: across the outline
/// of the target seen from each place (sight.hpp, aim_points()) and over its height. Stops at the first hit.
/// Without a hit, none of the flights of this resolution is one; between them there may be one. The flights
/// of one place, bearing and pitch lie above one another, so a blocker decides a whole range of them at once;
/// the rest is decided one by one. If `stop` is requested, the search ends early. O(places in range x pitches
/// x bearings), times the number of heights at worst.
Exhausted exhaust(const ShotRules& rules, const FlightSpace& space, const Target& target,
                  const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                  const std::stop_token& stop = {});

}  // namespace outrider
