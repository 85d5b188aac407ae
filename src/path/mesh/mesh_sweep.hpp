// Cuts any region bounded by straight sides into triangles on the corners of its border.
//
// A line sweeps up the plane, from corner to corner by row, then by column. For each part of the line inside
// the region, a chain of corners leads from the lower end of the side on its left to that of the side on its
// right, and everything below the chain is cut. The chain rises to the corner that was processed last, falls
// from there, and is bent so that no more triangles can be cut off. The next corner sees it from one of its
// ends, or from its top. The region may have holes, several parts, and corners at which parts of its border
// meet. No corners are added, and all computations are in integers. O(n log n) for n corners, if few sides
// are open at a time.
// Source: Hertel and Mehlhorn, Fast triangulation of simple polygons (1983).
#pragma once

#include <vector>

#include "mesh_triangles.hpp"

namespace outrider {

/// The order in which the sweep comes to the corners: by row, then by column.
inline bool earlier(Cell a, Cell b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

/// A side of the border, with the region on its left. Sides meet only at their ends.
struct BorderSide {
  Cell from, to;
};

Triangulation cut_region(const std::vector<BorderSide>& border);

}  // namespace outrider
