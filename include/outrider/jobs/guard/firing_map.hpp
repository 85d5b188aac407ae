// FiringMap: the yard of a guard problem, made ready for planning and for execution.
//
// Everything here follows from the problem and the options alone: what the robot can bump into, where
// it can stand, what a flight can touch, and from where each target can be hit.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/ballistics/firing_region.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/world/collision_map.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Why a target has no firing region.
struct Proof {
  std::optional<Exhausted> exhausted;  ///< set when shots at its centre found no place
  bool from_elsewhere = false;         ///< it could be hit from ground that cannot be driven to
};

struct FiringMap {
  ShotRules rules;
  std::vector<FlightSpace> spaces;  ///< one for all targets, or one for each when targets block
  CollisionMap ground;
  GridFrame frame;
  std::vector<std::uint8_t> standable;  ///< by cell: the disk of the robot fits at its centre
  std::vector<std::uint8_t> reachable;  ///< by cell: and the robot can drive there, cell to cell
  std::vector<float> clearance_m;       ///< by cell: from its centre to the nearest obstacle or edge
  std::vector<std::uint32_t> homeward;  ///< by reachable cell: the next one on a way to the start; itself
                                        ///< where the start is seen
  std::vector<FiringRegion> regions;    ///< by target, over the reachable cells
  std::vector<Proof> proofs;            ///< by target

  [[nodiscard]] const FlightSpace& space(std::size_t target) const {
    return spaces.size() == 1 ? spaces.front() : spaces[target];
  }
};

/// How far the search for places to shoot from goes.
enum class RegionSearch : std::uint8_t {
  proven,  ///< a target without one gets exhaust()'s proof that there is none, or the place that it finds
  centres_only,  ///< shots at the centre of each target are tried; no proofs
  none           ///< there are no regions
};

/// Refused: an empty or too fine grid (memory), a start that is blocked or outside, a target whose
/// centre is inside a solid, numbers that are not finite or out of the range of their option. O(cells x
/// targets); regions in parallel, with the same result for any number of threads.
Outcome<FiringMap> build_firing_map(const GuardProblem& problem, const GuardOptions& options,
                                    const Budget& budget = {}, RegionSearch search = RegionSearch::proven);

}  // namespace outrider
