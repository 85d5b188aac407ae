// Contours: lines of equal height of a height field, for display on maps.
#pragma once

#include <vector>

#include "outrider/world/height_field.hpp"

namespace outrider {

struct Contour {
  double height_m = 0.0;
  std::vector<Vec2> points;  ///< if the line is closed, the last point equals the first
};

/// Returns the contours at all multiples of `step_m` strictly between the lowest and the highest point, exact
/// on the triangles. The same field gives the same lines in the same order. O(cells + points) for each
/// height.
std::vector<Contour> contours(const HeightField& field, double step_m);

/// Returns a step of 1, 2 or 5 times a power of ten that gives at most 12 heights.
double contour_step(const HeightField& field);

}  // namespace outrider
