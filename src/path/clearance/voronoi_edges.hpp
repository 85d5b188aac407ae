// The generalised Voronoi diagram of polygon ground: where two features are equally near.
//
// Edges are cut where they cross or touch, with corners on a lattice of 2^30 steps across the map, by
// rounding the crossings to it until none is left (iterated snap rounding, Halperin and Packer 2002); then
// Boost.Polygon finds the diagram, with exact predicates in whole numbers. So the diagram is that of polygons
// whose corners are off by at most `step_m`; an edge that was cut may bend there by a step, and have a branch
// of the diagram that leads straight away from the bend. O(n^2) pairs of edges, and O(n log n).
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

/// What lies on free ground.
struct VoronoiEdges {
  double step_m = 0.0;  ///< of the lattice
  std::vector<Vec2> nodes;
  std::vector<VoronoiEdge> edges;
};

VoronoiEdges voronoi_edges(const PolygonGround& ground);

}  // namespace outrider
