// Which solid is the floor, and how far the yard reaches.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// An upright half-space and the size that its file gives it.
struct FloorPlane {
  Vec3 point;
  Vec2 size;
};

/// Sets floor_z_m and bounds, as sdf.hpp says; `planes` are the world's upright half-spaces.
Status set_floor_and_bounds(World& world, const std::vector<FloorPlane>& planes, const std::string& name);

}  // namespace outrider
