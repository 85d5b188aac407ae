// World changes: objects of a world are moved or removed.
//
// A name means the solid with that name and all solids whose names begin with it and a '/'. The name of an
// SDF model therefore means all of its parts. The heights above the ground under the middle of an object stay
// the same, and so do the bounds of the world.
//
// Faults: bad_input with "moved" or "removed"; for an unknown name, with similar names. The ground cannot be
// moved or removed. O(names x solids).
#pragma once

#include <string>
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
/// in a list (io/scenario/world_changes.hpp).
std::vector<MovableThing> movable_things(const World& world);

}  // namespace outrider
