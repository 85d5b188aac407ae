// Cuts the free space of a grid into triangles whose corners are those of the obstacles.
//
// The free space is divided into slabs, rectangles of equal runs of cells in neighbouring rows. The corners
// on the lower and upper border of a slab are joined to a strip of triangles. Each remaining part, between
// the strips and a wall, is a polygon with one long side and a monotone chain, and is cut from bottom to top.
// No corners are added. O(cells).
// Source: monotone mountains, Fournier and Montuno, Triangulating simple polygons and equivalent problems
// (1984).
#pragma once

#include <array>
#include <stop_token>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

struct Triangulation {
  std::vector<Cell> corners;                            ///< by row, then by column
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
};

/// A stop leaves triangles out.
Triangulation cut_into_triangles(const GridMap& ground, const std::stop_token& stop = {});

}  // namespace outrider
