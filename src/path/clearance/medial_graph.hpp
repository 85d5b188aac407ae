// The medial axis as a graph for one start and one goal, and the searches on it.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/search/best_first.hpp"
#include "outrider/search/workspace.hpp"
#include "voronoi_edges.hpp"

namespace outrider {

/// Another search keeps a clearance that was found here less this share of it, for rounding.
inline constexpr double kept_rounding = 1e-9;

/// The straight path from a point, away from the nearest edge, to the axis.
struct Retraction {
  Bisector leg;             ///< begins at the point; its clearance grows along it
  std::uint32_t joint = 0;  ///< the node where it meets the axis
};

struct MedialGraph {
  std::vector<Vec2> nodes;
  std::vector<VoronoiEdge> edges;
  std::vector<std::uint32_t> first;  ///< start of each node in `incident`; one more at the end
  std::vector<std::uint32_t> incident;
  Retraction start;
  Retraction goal;
  double rounding_m = 0.0;  ///< rounding error of clearances
  double least_m = 0.0;     ///< narrower parts count as closed
  double widest_m = 0.0;    ///< largest clearance on the axis
};

/// Makes the graph for two free places. The workspace keeps the axis of the ground. O(n) for n edges, O(n^2)
/// at the first query on a ground.
MedialGraph medial_graph(const std::shared_ptr<const PolygonGround>& ground, Vec2 start, Vec2 goal,
                         Workspace& workspace);

/// Returns the largest clearance that a path from start to goal can keep, m. Faults: those of best_first().
Outcome<double> largest_clearance(const MedialGraph& graph, BudgetMeter& meter, Workspace& workspace);

/// Returns the parts of the path from start to goal with the least length + weight * exposure whose clearance
/// is nowhere below `least_m`. Faults: those of best_first().
Outcome<std::vector<Bisector>> least_exposed(const MedialGraph& graph, double least_m, double weight_m,
                                             BudgetMeter& meter, Workspace& workspace);

}  // namespace outrider
