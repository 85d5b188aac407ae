// ExplorationReference: what of a world a robot with a range finder can see at all, and how good a map of it
// is.
//
// Places lie at the centres of the cells of a lattice through the origin of the world. The robot can be at a
// place when its disk can be swept there, exactly, along steps between neighbouring places (four each), from
// a place beside its start. A place can be seen when a line of sight at the laser's height, no longer than
// its range, leads from there to a place where the robot can be: one of the nearest twelve, or one along 720
// directions. Finds visible neighbours of visible cells.
//
// O(places x obstacles near them), plus O(directions x range / resolution) for each place seen from afar
// only.
#pragma once

#include <cstdint>

#include "outrider/core/outcome.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/sim/open_ground.hpp"
#include "outrider/sim/range_finder.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

enum Seeable : std::uint8_t {
  not_seeable = 0,
  beside_surface = 1,  ///< can be seen, but is nearer to a surface than a cell: there a map shows the surface
  only_seeable = 2,
  reachable = 3,
};

struct ExplorationReference {
  Grid<std::uint8_t> places;  ///< values of Seeable, for the centres of the cells
  double reachable_m2 = 0.0;  ///< where the middle of the robot can be
  double seeable_m2 = 0.0;    ///< all that can be seen, that included
  Box2 standing;              ///< the box of all that stands
  bool leaks = false;         ///< the robot can leave that box: the world has no end
  Vec2 leaks_at;              ///< of the places outside, the one that it reaches in the fewest steps
};

/// Faults: start_blocked when the robot touches something at its start, with the nearest place where it would
/// not; bad_input when the world is larger than 25 million places.
Outcome<ExplorationReference> exploration_reference(const RangeFinder& laser, const OpenGround& ground,
                                                    Vec2 start, double resolution_m = 0.05);

struct MapQuality {
  /// Part of the places that are only_seeable or reachable which the map knows to be free; 1 without any.
  double explored_fraction = 0.0;
  /// Mean distance from the centres of the occupied cells to the nearest surface at the laser's height, no
  /// cell more than 1 m. Maps are not moved: the start of the robot is exact.
  double map_error_m = 0.0;
  double mapped_free_m2 = 0.0;   ///< on the whole map
  double wrongly_free_m2 = 0.0;  ///< mapped free where it can neither be seen nor borders on what can
};

/// `occupancy` holds values of Occupancy, in the frame of the world. O(cells).
MapQuality map_quality(const ExplorationReference& truth, const RangeFinder& laser,
                       const Grid<std::uint8_t>& occupancy);

}  // namespace outrider
