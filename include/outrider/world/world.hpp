// World: what is known of a yard or a building. Immutable by use: planners take it by const
// reference, and with() gives a new one.
#pragma once

#include <memory>
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
  std::shared_ptr<const HeightField> terrain =
      {};  ///< the ground where it is not flat; one of the solids too

  [[nodiscard]] World with(Solid solid) const;
  /// On this ground instead of the floor: upright half-spaces and what was terrain before go, a solid
  /// "terrain" comes, and floor_z_m is its lowest height. A field as flat as the floor, at its height,
  /// changes nothing.
  [[nodiscard]] World on(std::shared_ptr<const HeightField> ground) const;
  /// Height of the ground on which the robot drives, m.
  [[nodiscard]] double ground_z_m(Vec2 p) const { return terrain ? terrain->height(p) : floor_z_m; }
};

/// The box around every solid that stands on the floor (half-spaces, height fields and anything flat on
/// it left out): the yard that walls enclose. Empty when nothing stands there.
Box2 standing_bounds(const World& world);

}  // namespace outrider
