// Cells that --block and --free change after a map is read.
#pragma once

#include "command.hpp"
#include "map_file.hpp"

namespace outrider::cli {

/// Both flags may be given any number of times.
void add_change_flags(Command& command);

/// First all of --block, then all of --free, on map.blocked. The fault names the flag and its value.
Status change_cells(const Command& flags, MapFile& map);

/// Refuses both flags, for grounds that are not cells.
Status refuse_changes(const Command& flags);

}  // namespace outrider::cli
