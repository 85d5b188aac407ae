// Clearance and exposure of a straight leg among polygons.
#pragma once

#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// The least distance to an edge, m; 0 where they cross. O(n).
double leg_clearance(const PolygonGround& ground, const Segment& leg);

/// The integral of 1 / clearance along the leg, which stays clear: Simpson's rule on pieces no longer than an
/// eighth of their clearance. O(n + exposure edges near the leg).
double leg_exposure(const PolygonGround& ground, const Segment& leg);

}  // namespace outrider
