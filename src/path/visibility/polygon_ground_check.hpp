// The verification of plans on polygons. It shares no clearance test and no index with the planners.
#pragma once

#include "outrider/path/plan.hpp"

namespace outrider {

/// Verifies a plan as check() describes, each piece against every edge. O(pieces n).
Status check_on_polygons(const Plan& plan, const Problem& problem);

/// Return the distance of a point or of an edge to a piece; 0 where they touch or cross. Exact.
double distance_to(const PathPiece& piece, Vec2 p);
double distance_to(const PathPiece& piece, const Segment& edge);

}  // namespace outrider
