// FiringMap: the yard of a guard problem, preprocessed for planning and execution.
//
// It holds the obstacles of the robot, the cells where the robot can stand, the obstacles of flights, and for
// each target the cells from which it can be hit. It depends only on the problem and the options.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/ballistics/blocked_flight.hpp"
#include "outrider/ballistics/firing_region.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/path/routes/routes.hpp"
#include "outrider/world/collision_map.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Why no shot at a target was found. It is no proof that there is none: between the places, pitches and aim
/// points that were tried there may be one.
struct NoShot {
  std::optional<Exhausted> exhausted;    ///< set if shots at the centre of the target found no place
  bool from_elsewhere = false;           ///< the target could be hit from ground that the robot cannot reach
  std::optional<BlockedFlight> blocked;  ///< the flight that comes nearest to a hit
};

/// The preprocessed yard.
struct FiringMap {
  ShotRules rules;  ///< requirements for planned shots
  std::vector<FlightSpace>
      spaces;           ///< obstacles of flights: one for all targets, or one per target if they block
  CollisionMap ground;  ///< obstacles of the robot
  GridFrame frame;      ///< of the cells below
  std::vector<std::uint8_t> standable;  ///< by cell: the disk of the robot fits at its centre
  std::vector<std::uint8_t> reachable;  ///< by cell: standable, and the robot can drive there from the start
  std::vector<float> clearance_m;       ///< by cell: from its centre to the nearest obstacle or edge
  /// For each reachable cell: the next cell on a path to the start. A cell from which the start is visible
  /// refers to itself.
  std::vector<std::uint32_t> homeward;
  std::vector<FiringRegion> regions;  ///< by target, over the reachable cells
  std::vector<NoShot> no_shots;       ///< by target
  std::optional<Corners> corners;     ///< of `ground`, for the robot of the problem; unset without regions

  /// Returns the obstacles of flights to a target.
  [[nodiscard]] const FlightSpace& space(std::size_t target) const {
    return spaces.size() == 1 ? spaces.front() : spaces[target];
  }
  /// Returns the centre of a cell.
  [[nodiscard]] Vec2 place(std::size_t cell) const { return frame.centre(frame.cell(cell)); }
  /// Returns the cell that contains a place; nothing outside the grid.
  [[nodiscard]] std::optional<std::size_t> cell_of(Vec2 place) const {
    const Cell cell = frame.cell_at(place);
    return frame.contains(cell) ? std::optional(frame.index(cell)) : std::nullopt;
  }
  /// Returns true if the target can be hit from the cell.
  [[nodiscard]] bool has_shot(std::size_t target, std::size_t cell) const {
    return regions[target].pitch[cell] != FiringRegion::no_shot;
  }
};

/// Return what stands in the way of balls (one space for all targets, or one for each if they block), and of
/// the robot.
std::vector<FlightSpace> flight_spaces(const GuardProblem& problem);
World driving_world(const GuardProblem& problem);

/// How far the search for places to shoot from goes.
enum class RegionSearch : std::uint8_t {
  exhaustive,    ///< for a target without one, exhaust() tries everything that the resolution allows
  centres_only,  ///< shots at the centre of each target are tried, and nothing else
  none           ///< there are no regions
};

/// Builds the firing map. Faults: an empty grid, or one too fine for the memory limit; a start that is
/// blocked or outside; a target whose centre is inside a solid; numbers that are not finite or out of range;
/// a target without a shot at its centre for which exhaust() would try more than 1e13 flights; those of
/// find_corners(). O(cells * targets). Regions are computed in parallel; the result does not depend
/// on the number of threads.
Outcome<FiringMap> build_firing_map(const GuardProblem& problem, const GuardOptions& options,
                                    const Budget& budget = {},
                                    RegionSearch search = RegionSearch::exhaustive);

/// Returns the soonest exact shot at a target from a place, for a gun that has this pitch (best_shot()).
inline std::optional<PlannedShot> shot_from(const GuardProblem& problem, const FiringMap& firing_map,
                                            std::size_t target, Vec2 place, double pitch_rad) {
  return best_shot(firing_map.rules, firing_map.space(target), problem.targets[target], place, pitch_rad);
}

/// For a target whose region is empty: what was tried, at which resolution, and what stands in the way.
std::string why_unreachable(const GuardProblem& problem, const FiringMap& firing_map,
                            const GuardOptions& options, std::size_t target);

}  // namespace outrider
