// World changes: two keys of a scenario that move or remove objects of a world.
//
//     moved: bench=1.5,-2,90; shed=0,4,0
//     removed: tree_1; tree_2
//
// A name means the solid with that name and all solids whose names begin with it and a '/'. The name of an
// SDF model therefore means all of its parts. A move gives x and y in m, the new position of the middle of
// the upright box around these solids in the original world, and the angle in degrees by which they are
// turned about it, counter-clockwise. The heights above the ground under the middle stay the same, and so do
// the bounds of the world.
//
// Faults: bad_input with the key; for an unknown name, with similar names. The ground cannot be moved or
// removed. O(names x solids).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// A move of the solids with one name.
struct MovedThing {
  std::string name;
  Pose2 place;  ///< new position of the middle; heading_rad is the turn relative to the original world
  friend bool operator==(const MovedThing&, const MovedThing&) = default;
};

struct WorldChanges {
  std::vector<MovedThing> moved;
  std::vector<std::string> removed;
};

/// Parses the two values above; each may be empty.
Outcome<WorldChanges> changes_from_text(std::string_view moved, std::string_view removed);
/// Returns an angle in degrees as text, without rounding errors of whole numbers: 90, not 90.00000000000001.
std::string degrees_text(double angle_rad);
std::string moved_text(const std::vector<MovedThing>& moved);
std::string removed_text(const std::vector<std::string>& removed);

/// Returns the world with the changes. Faults: an unknown name; a solid with two changes; a change of the
/// ground (a half-space or a height field).
Outcome<World> changed(const World& world, const WorldChanges& changes);

/// An object that can be moved: all solids whose names have the same first part, up to a '/'.
struct MovableThing {
  std::string name;
  Vec2 middle;  ///< middle of the upright box around it, m
  std::vector<std::size_t> solids;
};

/// Returns the movable objects in the order of the world. Omits the ground, and names that cannot be written
/// in the values above.
std::vector<MovableThing> movable_things(const World& world);

}  // namespace outrider
