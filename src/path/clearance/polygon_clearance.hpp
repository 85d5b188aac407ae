// Clearance and exposure of a straight leg among polygons.
#pragma once

#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// Returns the least distance of the leg to an edge, m; 0 if they cross. O(n).
double leg_clearance(const PolygonGround& ground, const Segment& leg);

/// Returns the integral of 1 / clearance along a leg that touches no edge, by Simpson's rule on pieces no
/// longer than an eighth of their clearance. O(n + exposure edges near the leg).
double leg_exposure(const PolygonGround& ground, const Segment& leg);

}  // namespace outrider
