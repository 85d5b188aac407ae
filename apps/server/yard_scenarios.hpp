// Scenarios of the job guard on the page: where the robot starts, the targets sit and things of the world
// stand, changed by hand.
#pragma once

#include <string>
#include <vector>

#include "maps.hpp"
#include "outrider/io/files.hpp"

namespace outrider::server {

// Both functions read files, so they are called in the process that reads (reading.hpp).

/// {"job": "guard", "map": a packed map of what stands in the way of the robot, "start": [x, y],
/// "heading_rad", "targets":
/// [{"name", "position": [x, y, z], "size": [length, width, height], "heading_rad"}], "fixed": [polygon,
/// ...], "things": [{"name", "middle": [x, y], "polygons": [polygon, ...], "place": [x, y], "turn_rad",
/// "removed"}]}. The obstacles of the map are the fixed ones and those of the things, which are given as the
/// world has them and stand with their middle at their place, turned by so much (world_changes.hpp). Faults:
/// those of reading the scenario.
Outcome<Json> shown_yard(const std::filesystem::path& file);

/// The files of a changed yard under the name `path`, the scenario last, of
///   {"scenario": path of the one that is changed, "start": [x, y], "heading_rad",
///    "targets": [{"name", "position": [x, y], "heading_rad"}],
///    "boxes": [[low x, low y, high x, high y, turn_rad]],
///    "moved": [{"name", "place": [x, y], "turn_rad"}], "removed": [name, ...]}
/// A target of a name that the scenario has keeps its size and its height above the ground, and its heading
/// where none is given; one of another name is a cat (type 1) on the ground; those that are not named are
/// left out. A box is an obstacle 1 m high on the ground, turned about its middle, in a copy of the world; a
/// world that names files is copied within its folder only. Moved and removed are things; where either is
/// given, both replace what the scenario has. All else stays as the scenario has it. Fault: bad_input on a
/// request that is wrong.
Outcome<std::vector<NamedContent>> yard_files(const std::string& path, const Json& request,
                                              const Folder& folder);

}  // namespace outrider::server
