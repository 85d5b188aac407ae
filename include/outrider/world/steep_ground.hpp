// Steep ground: the part of a height field that is too steep for a robot, as obstacles.
#pragma once

#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

/// Returns rectangles that cover exactly the cells with a triangle steeper than `max_slope_rad`. Equal runs
/// of cells in consecutive rows become one rectangle. If there are more than `most`, blocks of 2 x 2 cells
/// are treated as one cell, then blocks of 4 x 4, and so on; the obstacles then cover more ground, never
/// less. O(cells).
std::vector<RoundedPolygon> steep_ground(const HeightField& field, double max_slope_rad,
                                         std::size_t most = 300);

}  // namespace outrider
