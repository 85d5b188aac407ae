// A grid from polygons, for a disk robot.
//
// As from_world.hpp: a cell is free when every point of its closed square is at least the radius away
// from every edge and outside all solid ground, by exact distances between square and edge. So every path
// on the grid, in both models, is free of collision for the disk, and a way with more clearance than
// radius + sqrt(2) resolution runs through free cells only. The grid spans the boundary; its origin is
// the lowest corner of the boundary's box. O(cells near edges + cells log n). Fault: bad_input on a
// resolution that makes no grid, or one of more cells than the cap.
#pragma once

#include "outrider/path/from_world.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// 1 where the centre of the disk must not be.
Outcome<Grid<std::uint8_t>> blocked_for_disk(const PolygonGround& ground, const GridOptions& options);

}  // namespace outrider
