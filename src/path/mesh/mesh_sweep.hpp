// Cuts any region with a border of straight sides into triangles on the corners of that border.
//
// A line sweeps up the plane, from corner to corner by row, then by column. Where it lies in the region, a
// chain of corners leads from the lower end of the side on its left to that of the side on its right, and
// all below is cut. The chain rises to the corner that was passed last, falls from there, and is bent so
// that nothing more can be cut off; the next corner sees it from one of its ends, or its top. The region
// may have holes, several parts, and corners at which parts of its border meet. No corners are added; all in
// whole numbers. O(n log n) for n corners, while few sides are open at a time.
// Source: Hertel and Mehlhorn, Fast triangulation of simple polygons (1983).
#pragma once

#include <vector>

#include "mesh_triangles.hpp"

namespace outrider {

/// A side of the border, the region on its left. Sides meet at their ends alone.
struct BorderSide {
  Cell from, to;
};

Triangulation cut_region(const std::vector<BorderSide>& border);

}  // namespace outrider
