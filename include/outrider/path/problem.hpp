// Problem: the input of a path planner: known ground, a start and a goal.
//
// The ground is a grid or a set of polygons: one of the two pointers is set. A planner gets the ground that
// it works on through a query such as grid_query(), which refuses the other kind with a message.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"
#include "outrider/path/grid/terrain/cell_costs.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// A path planning problem.
struct Problem {
  std::shared_ptr<const GridMap> grid;                      ///< the ground as a grid, or null
  Vec2 start;                                               ///< m
  Vec2 goal;                                                ///< m
  std::shared_ptr<const PolygonGround> polygons = nullptr;  ///< the ground as polygons, or null
  /// Headings at the start and at the goal, for planners of robots that steer; unset: any. Others ignore
  /// them.
  std::optional<double> start_heading_rad = std::nullopt;
  std::optional<double> goal_heading_rad = std::nullopt;
  /// Costs per metre of the cells of the grid, for planners that weigh the ground; null: 1 everywhere. Others
  /// ignore them.
  std::shared_ptr<const CellCosts> costs = nullptr;
  /// Corners of the robot in its own frame, convex, counter-clockwise and around its origin, m, for planners
  /// of robots that steer; empty: it is a disk. The ground is grown by what lies beyond them: the radius of
  /// the disk, or of the robot's round corners.
  std::vector<Vec2> outline = {};
};

/// A problem on a grid, with start and goal as vertices of the grid.
struct GridQuery {
  const GridMap& ground;
  Cell start;
  Cell goal;
};

/// Converts a problem on a grid. Start and goal move to the vertex of their cell, or to the nearest corner,
/// depending on the grid model. Faults: bad_input if the problem has no grid; outside_map; start_blocked;
/// goal_blocked.
Outcome<GridQuery> grid_query(const Problem& problem);

/// Returns the polygons of the problem after checking that the disk of the robot fits at start and goal.
/// Faults: bad_input if the problem has no polygons; outside_map; start_blocked and goal_blocked, with the
/// distance to the nearest edge.
Outcome<std::shared_ptr<const PolygonGround>> polygon_query(const Problem& problem);

}  // namespace outrider
