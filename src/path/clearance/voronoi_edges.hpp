// The generalised Voronoi diagram of polygon ground: the points at which two features are equally near.
//
// Edges are cut where they cross or touch. Corners lie on a lattice of 2^30 steps across the map, and
// crossings are rounded to it until none is left (iterated snap rounding, Halperin and Packer 2002).
// Boost.Polygon then computes the diagram with exact integer predicates. So the result is the diagram of
// polygons whose corners are off by at most `step_m`; an edge that was cut may bend there by a step, and the
// diagram may have a branch that leads straight away from the bend. O(n^2) pairs of edges, and O(n log n).
#pragma once

#include <cstdint>
#include <vector>

#include "bisector.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

struct VoronoiEdge {
  std::uint32_t from = 0;  ///< nodes
  std::uint32_t to = 0;
  Bisector bisector;
};

/// The part of the diagram on free ground.
struct VoronoiEdges {
  double step_m = 0.0;  ///< step of the lattice
  std::vector<Vec2> nodes;
  std::vector<VoronoiEdge> edges;
};

VoronoiEdges voronoi_edges(const PolygonGround& ground);

}  // namespace outrider
