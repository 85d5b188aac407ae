// Ceres on the same pose graph, if it is installed.
#pragma once

#include <optional>

#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider::bench {

struct PeerResult {
  double cost = 0.0;    ///< as computed by cost()
  double time_s = 0.0;  ///< time of the solver alone, without building its problem
  int iterations = 0;
};

/// Solves from the given poses on one thread, with sparse Cholesky factorisation, default tolerances and at
/// most 1000 iterations. Returns nothing without Ceres, or for graphs with points or ranges.
std::optional<PeerResult> solve_with_ceres(const PoseGraph& graph);
std::optional<PeerResult> solve_with_ceres(const PoseGraph3& graph);

}  // namespace outrider::bench
