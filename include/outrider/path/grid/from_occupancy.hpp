// A grid from an occupancy grid, such as a map server's, for a disk robot.
//
// The occupied cells are taken as full squares, and all beyond the grid as occupied. A cell is free
// when it is not occupied and its closed square is at least the radius away from every occupied square;
// touching is allowed. So every path on the grid, in both models, is free of collision for the disk.
// The distances are exact: the distance between two squares is that between one centre and the
// nearest of the nine cells around the other, so the occupied cells grown by one cell go through the exact
// Euclidean distance transform (world/clearance.hpp). O(cells), about 16 bytes a cell for the time of the
// call. Fault: bad_input on numbers that make no grid or a radius that is not finite or below 0.
#pragma once

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// 1 where the centre of a disk of that radius must not be. Cells other than 0 are occupied.
Outcome<Grid<std::uint8_t>> inflated(const Grid<std::uint8_t>& occupied, double radius_m);

/// The same prepared for searching.
Outcome<GridMap> grid_from_occupancy(const Grid<std::uint8_t>& occupied, double radius_m, GridModel model);

}  // namespace outrider
