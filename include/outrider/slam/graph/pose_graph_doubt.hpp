// Judges whether a solved pose graph can be believed: its cost, and each edge against all others.
//
// If the information matrices are right, the least cost is distributed as chi-square, and so is the cost that
// one edge adds. Where the matrices are too small, the cost of a graph with false edges can still be
// plausible; a false edge then stands out alone. A value is implausible five standard deviations above its
// mean (after Wilson and Hilferty, PNAS 17 (1931) 684-688), which chance alone exceeds once in three million
// times.
#pragma once

#include <optional>

#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

struct GraphDoubt {
  bool cost = false;                  ///< the cost is implausible for the degrees of freedom
  std::optional<std::uint32_t> edge;  ///< the edge that contradicts the others most, if one does implausibly
  double edge_cost = 0.0;             ///< by how much the cost would fall without that edge, to first order
  double refusable = 0.0;             ///< number of edges that are no odometry
};

/// `poses` are those of least cost. O(two factorisations).
template <class Pose>
GraphDoubt doubt_about(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses);

}  // namespace outrider
