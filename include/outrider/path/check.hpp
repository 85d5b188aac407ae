// check: an independent judge of plans. Shares no line of sight with the planners.
//
// Verifies that the path starts and ends at the vertices of the start and the goal, that every
// waypoint lies on its vertex, that every leg is legal in the model of the ground (separating axes in
// whole numbers, exact), that the cost is the sum of the legs to 1e-9 of itself, that an exposure in it is
// within 1 % of what safety_of() proves, that the lower bound is not above the cost, and that the path ends
// as near to the goal as it says. O(cells along the path). On polygons: that the pieces join, that each keeps
// the radius from every edge (exact distance between arc or leg and edge, to 2 contact_m), and that the
// waypoints stay within their error of the pieces. O(pieces edges). The fault says what is wrong, and at
// which leg.
#pragma once

#include "outrider/path/plan.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

Status check(const Plan& plan, const Problem& problem);

/// The least distance between the pieces of the plan (its waypoints, where it has none) and an edge, m.
double clearance_m(const Plan& plan, const PolygonGround& ground);

/// Whether a disk of that radius follows the waypoints without touching an obstacle, by the exact
/// shapes of the world instead of the grid.
Status check(const Plan& plan, const CollisionMap& ground, double radius_m);

}  // namespace outrider
