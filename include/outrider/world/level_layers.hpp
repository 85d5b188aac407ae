// Layers of a world: heights at which level surfaces cover much of the ground, such as the mesh of a floor or
// a slab of asphalt. One of them may be the ground on which the robot drives.
#pragma once

#include <vector>

#include "outrider/world/world.hpp"

namespace outrider {

/// A height and the area that level surfaces there cover.
struct Layer {
  double height_m = 0.0;    ///< height of its highest surface
  double covered_m2 = 0.0;  ///< area, overlaps counted once
};

/// Returns the layers that cover at least `least_m2` of a box on the ground, from low to high. Surfaces are
/// the tops of upright boxes, and the triangles of meshes that are level within 3 degrees, whichever way they
/// face. A layer is at most 0.03 m thick. Areas are counted on a raster of 128 x 128 places. O(s log s + s t)
/// for s surfaces that cover t places of the raster each.
std::vector<Layer> level_layers(const World& world, const Box2& over, double least_m2);

}  // namespace outrider
