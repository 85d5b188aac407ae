// Drive routes: what a path planner answers, as few waypoints for a robot on wheels.
//
// The planner is asked on polygons where it takes them, else on a grid of `resolution`. Its path is thinned
// by Ramer, Douglas and Peucker: no point of it lies farther than `thin` from the legs that are left, so
// length and clearance change by little more than that; a leg that would touch an obstacle is not taken.
// The last waypoint is a stop, the others are passed. A robot that moves sideways passes each with its
// camera towards the nearest tag that faces it, where there is one in sight, and otherwise looks ahead.
//
// Faults: those of the planner; bad_input on a name that the catalogue does not have.
// Sources: Ramer (1972); Douglas and Peucker (1973).
#pragma once

#include <string>
#include <vector>

#include "outrider/jobs/drive/task.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

struct DriveRouteOptions {
  double margin_m = 0.05;      ///< that the path keeps beyond the robot's radius
  double resolution_m = 0.05;  ///< of a grid
  double thin_m = 0.02;
};
std::vector<Option> describe(DriveRouteOptions& options);

struct DriveRoute {
  Plan plan;
  std::vector<Waypoint> waypoints;  ///< without the start
};

/// From task.start to the goal, over this ground with the task's robot and tags.
Outcome<DriveRoute> plan_route(const DriveTask& task, const CollisionMap& ground, const Pose2& goal,
                               const std::string& planner, const DriveRouteOptions& options);

/// The points of a polyline that are left when those within `thin_m` of the legs between them go; first and
/// last stay. A leg on which
/// the disk would touch an obstacle is not taken. O(n^2).
std::vector<Vec2> thinned(const std::vector<Vec2>& points, double thin_m, const CollisionMap& ground,
                          double radius_m);

/// Least distance from the legs between these points to an obstacle or the edge, m. Exact. O(points
/// obstacles).
double way_clearance_m(const std::vector<Vec2>& points, const CollisionMap& ground);

/// Refuses waypoints where the robot cannot stand, and straight ways between them that it cannot go.
Status check_waypoints(const DriveTask& task, const CollisionMap& ground);

}  // namespace outrider
