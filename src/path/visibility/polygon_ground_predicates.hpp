// Exact signs of the plane: no rounding, whatever the coordinates (short of overflow).
// Source: Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates
// (1997): sums of doubles kept as expansions of which no part overlaps another.
#pragma once

#include "outrider/geometry/convex.hpp"

namespace outrider {

/// 1 when a, b, c turn left, -1 right, 0 on one line.
int turn_of(Vec2 a, Vec2 b, Vec2 c);

/// Returns true if the closed segments have a point in common.
bool segments_meet(Segment s, Segment t);

}  // namespace outrider
