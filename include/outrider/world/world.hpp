// World: what is known of a yard or a building. Immutable by use: planners take it by const
// reference, and with() gives a new one.
#pragma once

#include <string>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

struct World {
  std::string name;
  Box2 bounds;                ///< the yard: the robot's disk stays inside
  double gravity_mps2 = 9.8;  ///< along -z
  double floor_z_m = 0.0;     ///< height of the ground on which the robot drives
  std::vector<Solid> solids;  ///< in the order of the file; the ground is one of them

  [[nodiscard]] World with(Solid solid) const;
};

/// The box around every solid that stands on the floor (half-spaces and anything flat on it left
/// out): the yard that walls enclose. Empty when nothing stands there.
Box2 standing_bounds(const World& world);

}  // namespace outrider
