// Problem: what a path planner is asked, a way over known ground from a start to a goal.
//
// The ground is a grid today. Another kind of ground (polygons) is another pointer beside it, of which
// one is set; a planner takes the one it works on through a query such as grid_query(), and refuses
// the others in a sentence.
#pragma once

#include <memory>

#include "outrider/path/grid_ground.hpp"

namespace outrider {

struct Problem {
  std::shared_ptr<const GridGround> grid;
  Vec2 start;  ///< m
  Vec2 goal;   ///< m
};

/// The same question in vertices of the grid.
struct GridQuery {
  const GridGround& ground;
  Cell start;
  Cell goal;
};

/// Start and goal are moved to the vertex of their cell, or to the nearest corner. Faults: bad_input
/// without a grid; outside_map; start_blocked; goal_blocked.
Outcome<GridQuery> grid_query(const Problem& problem);

}  // namespace outrider
