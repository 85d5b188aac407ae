// Scenarios of the job guard on the page: where the robot starts and the targets sit, moved by hand.
#pragma once

#include <string>
#include <vector>

#include "maps.hpp"
#include "outrider/io/files.hpp"

namespace outrider::server {

/// {"job": "guard", "map": what stands in the way of the robot, "start": [x, y], "heading_rad", "targets":
/// [{"name", "position": [x, y, z], "size": [length, width, height], "heading_rad"}]}. Faults: those of
/// reading the scenario.
Outcome<Json> shown_yard(const std::filesystem::path& file, MapStore& maps);

/// The files of a changed yard under the name `path`, the scenario last, of
///   {"scenario": path of the one that is changed, "start": [x, y], "targets": [{"name", "position": [x,
///   y]}],
///    "boxes": [[low x, low y, high x, high y]]}
/// A target of a name that the scenario has keeps its size, its heading and its height above the ground; one
/// of another name is a cat (type 1) on the ground; those that are not named are left out. A box is an
/// obstacle 1 m high on the ground, in a copy of the world; a world that names files is copied within its
/// folder only. All else stays as the scenario has it. Fault: bad_input on a request that is wrong.
Outcome<std::vector<NamedContent>> yard_files(const std::string& path, const Json& request,
                                              const Folder& folder);

}  // namespace outrider::server
