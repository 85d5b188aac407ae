// ExplorationReference: what a robot with a range finder can see of a known world, to measure the quality of
// a map.
//
// Places are the centres of the cells of a lattice through the origin of the world. The robot can reach a
// place if its disk can be swept there, exactly, along steps between neighbouring places (four each), from a
// place beside its start. A place is visible if a line of sight at the laser's height, no longer than its
// range, leads from it to a reachable place: one of the nearest twelve, or one along 720 directions. Finds
// visible neighbours of visible cells. A visible place lies behind a gap if fewer steps between visible
// places lead to it from one where the robot has room but comes by a gap only, or not at all, than from
// others with room.
//
// O(places x obstacles near them), plus O(directions x range / resolution) for each place that is visible
// only from afar.
#pragma once

#include <cstdint>

#include "outrider/core/outcome.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/sim/open_ground.hpp"
#include "outrider/sim/sensors/range_finder.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// The extent to which the robot can see or reach a place.
enum Seeable : std::uint8_t {
  not_seeable = 0,
  beside_surface = 1,  ///< visible, but within a cell of a surface, where a map shows the surface
  behind_gap = 2,  ///< visible, and nearer to where the robot would have room again but comes by a gap only
  only_seeable = 3,
  reachable = 4,
};

/// The reference of a world.
struct ExplorationReference {
  Grid<std::uint8_t> places;  ///< values of Seeable, for the centres of the cells
  double reachable_m2 = 0.0;  ///< area that the centre of the robot can reach
  double seeable_m2 = 0.0;    ///< visible area, with the reachable one
  Box2 standing;              ///< box of all obstacles
  bool leaks = false;         ///< the robot can leave that box: the world is open
  Vec2 leaks_at;              ///< the place outside that the robot reaches in the fewest steps
};

/// Computes the reference. A gap is one that leaves the robot less than `room_m` to either side. Faults:
/// start_blocked when the robot touches something at its start, with the nearest place where it would not,
/// and when the start is farther from the box of all obstacles than the laser sees; bad_input when nothing
/// stands in the world, or when it is larger than 25 million places.
Outcome<ExplorationReference> exploration_reference(const RangeFinder& laser, const OpenGround& ground,
                                                    Vec2 start, double room_m = 0.0,
                                                    double resolution_m = 0.05);

/// The quality of a map.
struct MapQuality {
  /// Fraction of the visible places farther than a cell from surfaces that are free in the map; 1 if there
  /// are none.
  double explored_fraction = 0.0;
  double explored_before_gaps = 0.0;  ///< the same without what lies behind gaps
  /// Mean distance from the centres of the occupied cells to the nearest surface at the laser's height; each
  /// distance counts 1 m at most. Maps are not aligned, because the start pose is exact.
  double map_error_m = 0.0;
  double mapped_free_m2 = 0.0;   ///< free area of the whole map
  double wrongly_free_m2 = 0.0;  ///< free in the map although neither visible nor beside a visible place
};

/// Measures a map. `occupancy` holds values of Occupancy, in the frame of the world. O(cells).
MapQuality map_quality(const ExplorationReference& truth, const RangeFinder& laser,
                       const Grid<std::uint8_t>& occupancy);

}  // namespace outrider
