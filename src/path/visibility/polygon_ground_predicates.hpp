// Exact geometric predicates in the plane: no rounding errors for any coordinates (short of overflow).
// Source: Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates (1997):
// sums of doubles stored as non-overlapping expansions.
#pragma once

#include "outrider/geometry/convex.hpp"

namespace outrider {

/// Returns 1 if a, b, c turn left, -1 if they turn right, 0 if they are collinear.
int turn_of(Vec2 a, Vec2 b, Vec2 c);

/// Returns true if the closed segments have a point in common.
bool segments_meet(Segment s, Segment t);

}  // namespace outrider
