// Determines the floor of a world and its bounds.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// A horizontal half-space and its size in the file.
struct FloorPlane {
  Vec3 point;
  Vec2 size;
};

/// Sets floor_z_m and bounds as described in sdf.hpp. `planes` are the horizontal half-spaces of the world.
Status set_floor_and_bounds(World& world, const std::vector<FloorPlane>& planes, const std::string& name);

}  // namespace outrider
