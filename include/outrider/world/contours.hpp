// Contours: lines of equal height of a height field, for maps.
#pragma once

#include <vector>

#include "outrider/world/height_field.hpp"

namespace outrider {

struct Contour {
  double height_m = 0.0;
  std::vector<Vec2> points;  ///< the first again at the end where the line is closed
};

/// The lines at all multiples of `step_m` above the lowest and below the highest point, exact on the
/// triangles. Same field, same lines in the same order. O(cells + points).
std::vector<Contour> contours(const HeightField& field, double step_m);

/// A step of 1, 2 or 5 times a power of ten that gives at most 12 heights.
double contour_step(const HeightField& field);

}  // namespace outrider
