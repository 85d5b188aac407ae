// Problem: what a path planner is asked, a way over known ground from a start to a goal.
//
// The ground is a grid or polygons: one of the pointers is set. A planner takes the one it works on
// through a query such as grid_query(), and refuses the others in a sentence.
#pragma once

#include <memory>

#include "outrider/path/grid/grid_map.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

struct Problem {
  std::shared_ptr<const GridMap> grid;
  Vec2 start;  ///< m
  Vec2 goal;   ///< m
  std::shared_ptr<const PolygonGround> polygons = nullptr;
};

/// The same question in vertices of the grid.
struct GridQuery {
  const GridMap& ground;
  Cell start;
  Cell goal;
};

/// Start and goal are moved to the vertex of their cell, or to the nearest corner. Faults: bad_input
/// without a grid; outside_map; start_blocked; goal_blocked.
Outcome<GridQuery> grid_query(const Problem& problem);

/// The polygons, once start and goal are known to be free for the disk. Faults: bad_input without
/// polygons; outside_map; start_blocked; goal_blocked, with the distance.
Outcome<std::shared_ptr<const PolygonGround>> polygon_query(const Problem& problem);

}  // namespace outrider
