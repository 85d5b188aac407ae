// Blocks: the cells of a map that are not free, as solids, and a border of such cells about a map.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

/// Makes upright boxes from low_z_m to high_z_m that together cover exactly the cells that are not free, each
/// cell once. Equal runs of cells in consecutive rows become one box. `occupancy` holds values of Occupancy.
/// The boxes are named "block_1", "block_2", ... in the order of their lowest rows. O(cells).
std::vector<Solid> blocks(const Grid<std::uint8_t>& occupancy, double low_z_m, double high_z_m);

/// Returns the map with one more cell on each side, of the state `border`. O(cells).
Grid<std::uint8_t> bordered(const Grid<std::uint8_t>& occupancy, Occupancy border);

}  // namespace outrider
