// Polylines: points joined by straight legs.
#pragma once

#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// Returns the sum of the lengths of the legs, m; 0 for fewer than two points. O(points).
double length_of(const std::vector<Vec2>& points);

/// Returns a part of the points, with the first and the last, whose polyline is within `tolerance_m` of all
/// of them. Typically O(n log n), at most O(n^2). Source: Douglas and Peucker, Cartographica 10 (1973)
/// 112-122.
std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance_m);

}  // namespace outrider
