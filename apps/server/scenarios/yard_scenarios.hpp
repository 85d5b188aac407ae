// Scenarios of the job guard on the page: start of the robot, targets and movable things, changed by hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "outrider/io/files/files.hpp"
#include "planning/maps.hpp"

namespace outrider::server {

// Both functions read files beneath the working folder, so call them in the reader process (reading.hpp).

/// Returns {"job": "guard", "map": a packed map of what blocks the robot, "start": [x, y], "heading_rad",
/// "targets": [{"name", "position": [x, y, z], "size": [length, width, height], "heading_rad"}], "fixed":
/// [polygon, ...], "things": [{"name", "middle": [x, y], "polygons": [polygon, ...], "place": [x, y],
/// "turn_rad", "removed"}]}. The obstacles of the map are the fixed ones and those of the things. Things are
/// given as in the world file; each is turned by turn_rad and moved with its middle to its place
/// (world_changes.hpp). Faults: those of reading the scenario.
Outcome<Json> shown_yard(const std::filesystem::path& file);

/// Returns the files of a changed yard under the name `path`, the scenario last, from
///   {"scenario": path of the one that is changed, "start": [x, y], "heading_rad",
///    "targets": [{"name", "position": [x, y], "heading_rad"}],
///    "boxes": [[low x, low y, high x, high y, turn_rad]],
///    "moved": [{"name", "place": [x, y], "turn_rad"}], "removed": [name, ...]}
/// A target whose name is in the scenario keeps its size and its height above the ground, and its heading if
/// none is given. A target with a new name is a cat (type 1) on the ground. Targets that are not named are
/// left out. A box is an obstacle 1 m high on the ground, turned about its middle, in a copy of the world; a
/// world that names files is copied within its folder only. "moved" and "removed" name things; if either is
/// given, both replace those of the scenario. All else stays as in the scenario. Fault: bad_input on an
/// invalid request.
Outcome<std::vector<NamedContent>> yard_files(const std::string& path, const Json& request);

}  // namespace outrider::server
