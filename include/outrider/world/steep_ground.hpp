// Steep ground: the part of a height field on which a robot does not drive, as obstacles.
#pragma once

#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

/// Rectangles that cover the cells with a triangle steeper than `max_slope_rad`, and no others: runs along
/// the rows, joined where they lie above one another. Where that takes more than `most` rectangles, blocks
/// of 2 x 2 cells count as one, then of 4 x 4, and so on: more ground is closed then, never less. O(cells).
std::vector<RoundedPolygon> steep_ground(const HeightField& field, double max_slope_rad,
                                         std::size_t most = 300);

}  // namespace outrider
