// Scenes: what the ground of a scenario looks like from above, small enough for a picture on a card.
#pragma once

#include <string>

#include "fields.hpp"
#include "files/folder.hpp"

namespace outrider::server {

inline constexpr int most_scene_cells = 240;               ///< along a side; larger grids are made coarser
inline constexpr std::size_t most_scene_obstacles = 5000;  ///< of a world; others are left out

/// Returns {"map": {"name", "grid" or "polygons"}, "start": [x, y] or null, "targets": [[x, y], ...]} of a
/// scenario. If several areas are to be covered, "others" in the map has the boundaries of all but the first.
/// The map is null if the scenario names no world, map or area. In a coarser grid a cell is
/// occupied if one of those that it stands for is. Call it in the reader process (reading.hpp). Faults: those
/// of reading the files; bad_input for files outside the folder.
Outcome<Json> scenario_scene(const std::string& path);

}  // namespace outrider::server
