// How long exploring takes at least, proven for a world that is known.
//
// Who maps a world sees every place where the robot can stand. Take some of these cells as witnesses. A
// witness c is seen only from the set V(c) of places within range of it with nothing between, so the robot's
// way comes into V(c) for each of them, in some order, and its length is no less than that of the shortest
// round through the start and the sets, where two sets are as far apart as their nearest points. That round
// is found exactly, by dynamic programming over sets of witnesses (Held and Karp, 1962). All approximations
// make the bound smaller:
//   V(c)       Points of cells q and c see each other only if the straight way between their centres stays
//              out of the cells all whose neighbours are solid too: every point of that way is within half a
//              diagonal of a cell, which is less than its side, of the ray that sees.
//   standing   The robot's centre may be anywhere in a cell unless all points of the cell are nearer than the
//              radius to something solid; witnesses are only cells that it surely reaches.
//   distances  Shortest ways along the eight moves between the corners of these cells, divided by 1.0824:
//              no such way is longer than that times the shortest of all (Bailey, Tovey, Uras, Koenig and
//              Nash, Path-length analysis for grid-based path planning, 2015). From a point to a corner of
//              its cell is at most half a diagonal.
//   time       of driving at full speed; turns and starts cost nothing.
//
// Witnesses are chosen farthest first. O(witnesses (cells log cells + cells in range x range / resolution) +
// witnesses^2 2^witnesses).
#pragma once

#include "outrider/core/outcome.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

struct ExploreBound {
  double least_m = 0.0;         ///< no way that sees all, and ends at home if so asked, is shorter
  double least_s = 0.0;         ///< the same at full speed
  std::vector<Vec2> witnesses;  ///< of the bound
};

struct ExploreBoundOptions {
  int witnesses = 10;  ///< at most, 1 to 16
  bool return_home = true;
};

/// Cells of `solid` other than 0 are; beyond its edge all is. Faults: outside_map; start_blocked; bad_input
/// on a frame that is none.
Outcome<ExploreBound> explore_bound(const Grid<std::uint8_t>& solid, Vec2 start, double range_m,
                                    const RobotModel& robot, const ExploreBoundOptions& options = {});

}  // namespace outrider
