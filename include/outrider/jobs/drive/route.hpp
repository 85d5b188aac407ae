// DriveRoute: the path of a planner as a few waypoints for a robot on wheels.
//
// The planner works on polygons if it supports them, else on a grid of `resolution_m`. Its path is simplified
// by the rule of Ramer, Douglas and Peucker: no point of it lies farther than `thin_m` from the remaining
// legs, so length and clearance change by little more than that. No leg touches an obstacle. The last
// waypoint is a stop; the robot passes the others. A robot that moves sideways points its camera at the
// nearest visible tag that faces it at each waypoint, and looks ahead if there is none.
//
// Faults: those of the planner; bad_input on a name that the catalogue does not have.
// Sources: Ramer (1972); Douglas and Peucker (1973).
#pragma once

#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/drive/task.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Options of the route.
struct DriveRouteOptions {
  double margin_m = 0.05;      ///< distance to obstacles in addition to the robot's radius
  double resolution_m = 0.05;  ///< cell size, for planners on grids
  double thin_m = 0.02;        ///< largest distance of the planned path from its waypoints' legs
};
/// Describes the options by name.
std::vector<Option> describe(DriveRouteOptions& options);

/// A planned route.
struct DriveRoute {
  Plan plan;                        ///< answer of the planner
  std::vector<Waypoint> waypoints;  ///< without the start
};

/// Plans a route from task.start to the goal for the task's robot and tags.
Outcome<DriveRoute> plan_route(const DriveTask& task, const CollisionMap& ground, const Pose2& goal,
                               const std::string& planner, const DriveRouteOptions& options,
                               const Budget& budget = {});

/// Removes points of a polyline that lie within `thin_m` of the remaining legs. Keeps the first and the last
/// point. On no new leg does the disk touch an obstacle. O(n^2).
std::vector<Vec2> thinned(const std::vector<Vec2>& points, double thin_m, const CollisionMap& ground,
                          double radius_m);

/// Returns the exact smallest distance from the legs between these points to an obstacle or the edge, m.
/// O(points obstacles).
double way_clearance_m(const std::vector<Vec2>& points, const CollisionMap& ground);

/// Refuses waypoints where the robot cannot stand, and if it drives `straight` from one to the next, straight
/// lines between them that are blocked.
Status check_waypoints(const DriveTask& task, const CollisionMap& ground, bool straight = true);

}  // namespace outrider
