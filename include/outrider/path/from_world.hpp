// Makes a grid for a disk robot from the exact shapes of a world.
//
// A cell is free if every point of its closed square is at least the radius away from every obstacle and from
// the edge of the bounds. The distance between square and obstacle is exact.
// Sound: every point of a legal leg lies in a closed free cell, so every path on the grid, in both grid
// models, is collision-free for the disk. So is the straight line from any point of a free cell to its
// centre. Complete up to the resolution: a blocked cell has a point within the radius of an obstacle, so the
// whole cell lies within radius + sqrt(2) resolution of it. A path with more clearance than that uses only
// free cells. Derivation: docs/planners/grid-from-world.md. O(cells near obstacles). Faults: bad_input if the
// numbers make no grid or more cells than `most_cells`; cancelled.
#pragma once

#include <stop_token>

#include "outrider/core/options.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Options of a grid.
struct GridOptions {
  double resolution_m = 0.1;                         ///< side of a cell
  std::int64_t most_cells = std::int64_t{1} << 24U;  ///< largest number of cells; more are refused
};
std::vector<Option> describe(GridOptions& options);

/// Returns a grid with 1 in each blocked cell, as defined above, and 0 in each free cell.
Outcome<Grid<std::uint8_t>> blocked_for_disk(const CollisionMap& ground, double radius_m,
                                             const GridOptions& options, const std::stop_token& stop = {});

/// Returns the grid as a GridMap, for use in a Problem.
Outcome<GridMap> grid_from_world(const CollisionMap& ground, double radius_m, GridModel model,
                                 const GridOptions& options, const std::stop_token& stop = {});

}  // namespace outrider
