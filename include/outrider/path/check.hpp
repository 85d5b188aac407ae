// check: an independent verification of plans. It shares no line-of-sight code with the planners.
//
// On every ground it verifies that
//  - the path begins at the start and ends at the goal (on a grid: at their vertices),
//  - the cost is the sum of the legs, to a relative error of 1e-9, where the ground has costs their integral
//    (cut at every line of the grid),
//  - an exposure in the cost is within 1 % of the value that safety_of() proves,
//  - the lower bound is not above the cost, and
//  - the path ends as near to the goal as the plan states.
// On a grid it also verifies that every waypoint lies on its vertex and that every leg is legal in the grid
// model (separating axes in integers, exact). O(cells along the path).
// If the robot steers, it verifies instead that the pieces join in position and heading, that no arc is
// tighter than the turning radius, that its outline touches no blocked cell along any piece (exact, by the
// ways of its corners and, in the frame of the robot, by the ways of the corners of the cells), and that the
// waypoints stay within their error. On polygons it also verifies that the pieces join, that each
// piece keeps the radius from every edge (exact distance between arc or leg and edge, to 2 contact_m), and
// that the waypoints stay within their stated error of the pieces. O(pieces * edges). The fault states what
// is wrong and at which leg.
#pragma once

#include <stop_token>

#include "outrider/path/plan.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Verifies the plan as described above. Fault besides: cancelled.
Status check(const Plan& plan, const Problem& problem, const std::stop_token& stop = {});

/// Returns the least distance between the path and an edge, m. The path is made of the pieces of the plan, or
/// of the legs between its waypoints if it has no pieces.
double clearance_m(const Plan& plan, const PolygonGround& ground);

/// Verifies that a robot with that outline (as in Problem), grown by a radius, can follow the plan without
/// touching an obstacle. It uses the exact shapes of the world instead of the grid. On arcs it is exact to
/// hulls_error_m().
Status check(const Plan& plan, const CollisionMap& ground, double radius_m,
             const std::vector<Vec2>& outline = {});

}  // namespace outrider
