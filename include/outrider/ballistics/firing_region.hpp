// Firing regions: for every place where the robot may stand, whether it can hit a target from there.
//
// Decided for every place of a grid, over the pitches of a lattice and aim points on the target, each
// with the one speed that passes the aim point: does the ball, with the margin around it, reach the
// target before it touches anything? Exact up to the contact tolerance (contact.hpp).
//
// How it is fast: places learn their few blockers from a sweep of shadows along grid rows (blocker.hpp);
// a blocker is a rectangle in the plane of the flight until that is not enough (sight.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "outrider/ballistics/shot.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// The pitches tried, rad, ascending: from the lowest to the highest in equal steps of at most
/// `pitch_step_rad`, but no more than 255 of them.
std::vector<double> pitch_lattice(const ShotRules& rules);

struct FiringRegion {
  static constexpr std::uint8_t no_shot = 255;

  std::vector<std::uint8_t> pitch;        ///< by cell: index on the pitch lattice, or no_shot
  std::vector<float> error_ratio;         ///< by cell: of that shot (shot.hpp); infinite without one
  std::size_t places = 0;                 ///< standable cells
  std::size_t in_range = 0;               ///< of these, within reach if nothing stood in the way
  std::size_t hits = 0;                   ///< of these, with a shot
  std::vector<std::uint32_t> blocked_by;  ///< by solid: places where it stops the flattest shot
};

/// All places, clear of the target, from which a shot at the target's centre hits; the flattest with a
/// error_ratio of at most 0.7, else the one with the least error_ratio. `standable` is 1 where the robot may
/// stand, by cell. Once `stop` is raised no more places are tried, and the region is of no use. O(places in
/// reach x blockers in the line of sight); thread-safe for const arguments.
FiringRegion firing_region(const ShotRules& rules, const FlightSpace& space, const Target& target,
                           const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                           const std::stop_token& stop = {});

/// What was tried before a target is called unreachable.
struct Exhausted {
  std::size_t places = 0;     ///< standable cells within reach
  std::uint64_t flights = 0;  ///< decided; none is a hit with the margin, but for the one of `found`
  std::vector<std::uint64_t>
      blocked_by;                    ///< by solid: flights that it stops; one that several stop counts once
  std::optional<std::size_t> found;  ///< a cell with a hit, where the search ended
  Shot shot;                         ///< from there
};

/// As firing_region, with aim points at most `aim_step_m` apart: across the outline that the target shows
/// to each place (sight.hpp, aim_points) and over its height; stops at the first hit. Without a hit it is
/// the proof, at this resolution, that there is none. The flights over one place, bearing and pitch stand
/// above one another, so a blocker settles a whole run of them at once; the rest is decided one by one.
/// Once `stop` is raised the search ends, and proves nothing.
/// O(places in reach x pitches x bearings), times the heights at worst.
Exhausted exhaust(const ShotRules& rules, const FlightSpace& space, const Target& target,
                  const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                  const std::stop_token& stop = {});

}  // namespace outrider
