// Makes a grid for a disk robot from polygons, like from_world.hpp.
//
// A cell is free if every point of its closed square is at least the radius away from every edge and outside
// all solid ground. The distance between square and edge is exact. So every path on the grid, in both grid
// models, is collision-free for the disk, and a path with more clearance than radius + sqrt(2) resolution
// uses only free cells. The grid covers the boundary; its origin is the lowest corner of the boundary's
// bounding box. O(cells near edges + cells log n). Faults: bad_input if the resolution makes no grid or more
// cells than `most_cells`; cancelled.
#pragma once

#include <stop_token>

#include "outrider/path/from_world.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// Returns a grid with 1 in each blocked cell and 0 in each free cell.
Outcome<Grid<std::uint8_t>> blocked_for_disk(const PolygonGround& ground, const GridOptions& options,
                                             const std::stop_token& stop = {});

}  // namespace outrider
