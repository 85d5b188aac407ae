// Triangles in space.
#pragma once

#include <array>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// Returns the distance from p to a filled triangle, m. Exact; O(1).
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.5.
double distance_to_triangle(Vec3 p, const std::array<Vec3, 3>& triangle);

}  // namespace outrider
