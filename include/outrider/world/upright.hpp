// Upright walls and prisms as solids.
#pragma once

#include <string>
#include <vector>

#include "outrider/world/solid.hpp"

namespace outrider {

/// Makes a solid from two corners, a wall, or from a convex polygon, between two heights. A wall becomes a
/// box without thickness. A rectangle becomes a box whose corners are within 0.2 mm of the given ones. Any
/// other polygon becomes a mesh of its sides and of a floor 15 cm above its foot, at most at half its height.
Solid upright(const std::vector<Vec2>& corners, const std::string& name, double z_low_m, double z_high_m);

}  // namespace outrider
