// Makes a grid for a disk robot from an occupancy grid, such as that of a map server.
//
// Occupied cells count as full squares, and everything outside the grid as occupied. A cell is free if it is
// not occupied and its closed square is at least the radius away from every occupied square; touching is
// allowed. So every path on the grid, in both grid models, is collision-free for the disk. Distances are
// exact: the distance between two squares is the distance from the centre of one to the nearest of the nine
// cell centres in and around the other. So the occupied cells, dilated by one cell, go through the exact
// Euclidean distance transform (world/clearance.hpp). O(cells), with about 16 temporary bytes per cell.
// Faults: bad_input if the numbers make no grid, or for a radius that is negative or not finite; cancelled.
#pragma once

#include <stop_token>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// Returns a grid with 1 in each cell where the centre of a disk of that radius must not be. Cells other than
/// 0 are occupied.
Outcome<Grid<std::uint8_t>> inflated(const Grid<std::uint8_t>& occupied, double radius_m,
                                     const std::stop_token& stop = {});

/// Returns GridMap::of() the cells, and ends soon after a stop request. Faults: those of GridMap::of();
/// cancelled.
Outcome<GridMap> grid_map_of(const Grid<std::uint8_t>& blocked, GridModel model, const std::stop_token& stop);

/// Returns the same grid as a GridMap, for use in a Problem.
Outcome<GridMap> grid_from_occupancy(const Grid<std::uint8_t>& occupied, double radius_m, GridModel model);

}  // namespace outrider
