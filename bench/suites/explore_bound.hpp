// explore_bound(): a proven lower bound of the time of an exploration in a known world.
//
// A robot that maps a world sees every place where it can stand. Take some of these cells as witnesses. A
// witness c is visible only from the set V(c) of places within range of it with a free line of sight, so the
// path of the robot enters V(c) for each witness, in some order. Its length is at least that of the shortest
// round through the start and the sets, where the distance of two sets is that of their nearest points.
// Dynamic programming over up to ten witnesses finds that round exactly (Held and Karp, 1962); for a closed
// path, the ascent of Held and Karp (1971) bounds it for more of them, and leaves out those that lower the
// bound. The best counts. All approximations make the bound smaller:
//   V(c)       Points of cells q and c see each other only if the straight line between their centres avoids
//              all cells whose neighbours are all solid: every point of that line is within half a diagonal
//              of a cell, which is less than its side, of the ray between the points. With `exact_cells`,
//              only if free cells connect them within the strip that holds all rays between their points.
//   standing   The robot's centre may be anywhere in a cell unless all points of the cell are nearer than the
//   radius to
//              something solid. Witnesses are only cells that the robot certainly reaches.
//   distances  Shortest paths along the eight moves between the corners of these cells, divided by 1.0824: no
//   such path
//              is longer than that factor times the shortest of all (Bailey, Tovey, Uras, Koenig and Nash,
//              Path-length analysis for grid-based path planning, 2015). The distance from a point to a
//              corner of its cell is at most half a diagonal.
//   time       The robot drives at full speed; turns and starts cost nothing.
//
// Witnesses are chosen farthest first. O(witnesses (cells log cells + cells in range x range / resolution) +
// witnesses^4).
#pragma once

#include "outrider/core/outcome.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// A lower bound.
struct ExploreBound {
  double least_m = 0.0;         ///< no path that sees everything (and returns home, if asked) is shorter
  double least_s = 0.0;         ///< the time for that length at full speed
  std::vector<Vec2> witnesses;  ///< the witnesses of the proof
};

/// Options of the bound.
struct ExploreBoundOptions {
  int witnesses = 32;       ///< largest number of witnesses, 1 to 64
  bool return_home = true;  ///< the path ends at the start
  bool exact_cells =
      false;  ///< cells other than 0 are solid to their borders: walls of one cell hide what is behind
};

/// Returns the bound. Cells of `solid` other than 0 are solid, and so is everything outside the grid. Faults:
/// outside_map; start_blocked; bad_input on an invalid frame.
Outcome<ExploreBound> explore_bound(const Grid<std::uint8_t>& solid, Vec2 start, double range_m,
                                    const RobotModel& robot, const ExploreBoundOptions& options = {});

}  // namespace outrider
