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
#include <cstdint>
#include <stop_token>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// Returns twice the area of the triangle, > 0 if c lies to the left of the way from a to b. Exact.
inline std::int64_t turned(Cell a, Cell b, Cell c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

struct Triangulation {
  std::vector<Cell> corners;                            ///< by row, then by column
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
};

/// A stop leaves triangles out.
Triangulation cut_into_triangles(const GridMap& ground, const std::stop_token& stop = {});

}  // namespace outrider
