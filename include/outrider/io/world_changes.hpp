// What stands in a world, put elsewhere or taken away: two keys of a scenario.
//
//     moved: bench=1.5,-2,90; shed=0,4,0
//     removed: tree_1; tree_2
//
// A name stands for the solid of that name and for all whose names begin with it and a '/': the name of an
// SDF model for all of its parts. A move gives x, y in m, where the middle of the upright box around them (as
// the world has them) comes to stand, and by how many degrees they are turned about it, counter-clockwise,
// from how the world has them. Heights above the ground under the middle stay, and so do the bounds of the
// world.
//
// Errors: bad_input with the key; an unknown name lists those that are near; the ground stays. O(names x
// solids).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

struct MovedThing {
  std::string name;
  Pose2 place;  ///< of the middle; heading_rad is the turn from how the world has it
  friend bool operator==(const MovedThing&, const MovedThing&) = default;
};

struct WorldChanges {
  std::vector<MovedThing> moved;
  std::vector<std::string> removed;
};

/// From the two texts above, either of which may be empty.
Outcome<WorldChanges> changes_from_text(std::string_view moved, std::string_view removed);
/// An angle in degrees as people write it: 90, not 90.00000000000001.
std::string degrees_text(double angle_rad);
std::string moved_text(const std::vector<MovedThing>& moved);
std::string removed_text(const std::vector<std::string>& removed);

/// Faults: no such name; a solid that two names stand for; something without end, which is ground.
Outcome<World> changed(const World& world, const WorldChanges& changes);

/// Something that can stand elsewhere: all solids whose names have the same first part.
struct MovableThing {
  std::string name;
  Vec2 middle;  ///< of the upright box around it, m
  std::vector<std::size_t> solids;
};

/// In the order of the world. Without the ground, and what has a name that the texts above cannot hold.
std::vector<MovableThing> movable_things(const World& world);

}  // namespace outrider
