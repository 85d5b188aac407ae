// A grid from the exact shapes of a world, for a disk robot.
//
// A cell is free when every point of its closed square is at least the radius away from every obstacle
// and from the edge of the bounds, by the exact distance between square and obstacle. Every point of a
// legal leg lies in a closed free cell, so every path on the grid, in both models, is free of collision
// for the disk; so is the straight way from any point of a free cell to the cell's centre. Nothing is
// lost beyond the resolution: a blocked cell has a point no farther than the radius, so all of it lies
// within radius + sqrt(2) resolution of an obstacle, and a way with more clearance than that runs
// through free cells only. Derivation: docs/planners/grid-from-world.md.
// O(cells near obstacles). Fault: bad_input on numbers that make no grid, or one of more cells than
// the cap.
#pragma once

#include "outrider/core/options.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

struct GridOptions {
  double resolution_m = 0.1;
  std::int64_t most_cells = std::int64_t{1} << 24U;
};
std::vector<Option> describe(GridOptions& options);

/// 1 where the centre of a disk of that radius must not be, cell by cell as above.
Outcome<Grid<std::uint8_t>> blocked_for_disk(const CollisionMap& ground, double radius_m,
                                             const GridOptions& options);

/// The same prepared for searching.
Outcome<GridMap> grid_from_world(const CollisionMap& ground, double radius_m, GridModel model,
                                 const GridOptions& options);

}  // namespace outrider
