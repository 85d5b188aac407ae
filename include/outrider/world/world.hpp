// World: the known geometry of a yard or a building. Treat it as immutable: planners take it by const
// reference, and with() returns a changed copy.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

/// The solids of a world, its ground and its boundary.
struct World {
  std::string name;
  Box2 bounds;                                      ///< the disk of the robot must stay inside
  double gravity_mps2 = 9.8;                        ///< along -z
  double floor_z_m = 0.0;                           ///< height of the flat ground on which the robot drives
  std::vector<Solid> solids;                        ///< in the order of the file; includes the ground
  std::shared_ptr<const HeightField> terrain = {};  ///< uneven ground, also one of the solids; null if flat

  /// Returns a copy with one more solid.
  [[nodiscard]] World with(Solid solid) const;
  /// Returns a copy with the height field as its ground. Horizontal half-spaces and an earlier terrain are
  /// removed, a solid "terrain" is added, and floor_z_m becomes the lowest height of the field. If the world
  /// has a flat ground and the field is equal to it, the copy is unchanged.
  [[nodiscard]] World on(std::shared_ptr<const HeightField> ground) const;
  /// Returns the height of the ground on which the robot drives, m.
  [[nodiscard]] double ground_z_m(Vec2 p) const { return terrain ? terrain->height(p) : floor_z_m; }
};

/// Returns the bounding box of all solids that stand on the floor: the yard that the walls enclose.
/// Half-spaces, height fields and anything that lies flat on the floor do not count. Empty if nothing stands
/// there.
Box2 standing_bounds(const World& world);

}  // namespace outrider
