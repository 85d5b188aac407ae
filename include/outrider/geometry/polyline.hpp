// Polylines: points joined by straight legs.
#pragma once

#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// Returns the sum of the lengths of the legs, m; 0 for fewer than two points. O(points).
double length_of(const std::vector<Vec2>& points);

}  // namespace outrider
