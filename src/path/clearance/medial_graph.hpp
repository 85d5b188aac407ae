// The medial axis as a graph for one start and one goal, and the searches on it.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/search/best_first.hpp"
#include "outrider/search/workspace.hpp"
#include "voronoi_edges.hpp"

namespace outrider {

/// Straight away from the nearest edge to the axis.
struct Retraction {
  Bisector leg;             ///< from the point on, clearance growing with every metre
  std::uint32_t joint = 0;  ///< the node where it meets the axis
};

struct MedialGraph {
  std::vector<Vec2> nodes;
  std::vector<VoronoiEdge> edges;
  std::vector<std::uint32_t> first;  ///< of each node in `incident`, and one more
  std::vector<std::uint32_t> incident;
  Retraction start;
  Retraction goal;
  double rounding_m = 0.0;  ///< of clearances
  double least_m = 0.0;     ///< narrower parts count as closed
  double widest_m = 0.0;    ///< of all its places
};

/// The graph for two free places. The axis of the ground is kept in the workspace. O(n) for n edges, O(n^2)
/// at the first query on a ground.
MedialGraph medial_graph(const std::shared_ptr<const PolygonGround>& ground, Vec2 start, Vec2 goal,
                         Workspace& workspace);

/// The largest clearance that a path from start to goal can keep, m. Faults of best_first().
Outcome<double> largest_clearance(const MedialGraph& graph, BudgetMeter& meter, Workspace& workspace);

/// From start to goal, the parts of the way of least length + weight * exposure that is nowhere narrower than
/// that. Faults of best_first().
Outcome<std::vector<Bisector>> least_exposed(const MedialGraph& graph, double least_m, double weight_m,
                                             BudgetMeter& meter, Workspace& workspace);

}  // namespace outrider
