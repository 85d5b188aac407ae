// Ground as polygons.
#pragma once

#include <memory>

#include "faults.hpp"
#include "outrider/path/visibility/polygons_from_world.hpp"
#include "outrider/world/world.hpp"

namespace outrider::python {

using SharedPolygons = std::shared_ptr<PolygonGround>;

/// Returns the ground of a disk of that radius and height.
inline SharedPolygons polygons_of(const World& world, double radius_m, double height_m) {
  return std::make_shared<PolygonGround>(
      value_of(polygons_from_world(CollisionMap::of(world, height_m), radius_m)));
}

}  // namespace outrider::python
