// Target: an upright box that the ball must touch.
#pragma once

#include <string>

#include "outrider/geometry/vec.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

/// A target.
struct Target {
  std::string name;
  Vec3 base;             ///< centre of the bottom face, world frame, m
  Vec3 size;             ///< length along its heading, width, height, m
  double yaw_rad = 0.0;  ///< heading

  [[nodiscard]] Vec3 centre() const { return {base.x, base.y, base.z + 0.5 * size.z}; }
};

/// Returns the box of the target as a solid of the same name.
Solid solid_of(const Target& target);

}  // namespace outrider
