// Cells that --block and --free change after a map is read.
#pragma once

#include <CLI/CLI.hpp>

#include "map_file.hpp"

namespace outrider::cli {

/// Both flags may be given any number of times.
void add_change_flags(CLI::App& app);

/// First all of --block, then all of --free, on map.blocked. The fault names the flag and its value.
Status change_cells(const CLI::App& flags, MapFile& map);

/// Refuses both flags, for grounds that are not cells.
Status refuse_changes(const CLI::App& flags);

}  // namespace outrider::cli
