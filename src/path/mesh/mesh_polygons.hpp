// Merges triangles into convex polygons.
//
// First the sides between the triangles are flipped until they are Delaunay, as far as the obstacles allow.
// Then sides are removed, longest first, where that leaves a convex polygon. The result has few long polygons
// in open ground, and small polygons in the corners of walls, where few paths lead. O(n log n), plus the
// flips, of which there are O(n) in practice.
// Sources: flips, Lawson, Software for C1 surface interpolation (1977); merging, Hertel and Mehlhorn, Fast
// triangulation of simple polygons (1983).
#pragma once

#include "mesh_triangles.hpp"

namespace outrider {

/// Convex polygons, one after another, counter-clockwise.
struct ConvexPolygons {
  struct Side {
    std::uint32_t corner;   ///< start of the side; it ends at the start of the next side
    std::uint32_t behind;   ///< the same side of the polygon behind it, or no_side
    std::uint32_t polygon;  ///< to which it belongs
  };
  static constexpr std::uint32_t no_side = ~std::uint32_t{0};

  std::vector<Side> sides;
  std::vector<std::uint32_t> first;  ///< side of each polygon; one more at the end
};

/// A stop leaves polygons out.
ConvexPolygons join_triangles(const Triangulation& cut, const std::stop_token& stop = {});

}  // namespace outrider
