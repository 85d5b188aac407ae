// Ceres on the same pose graph, where it is installed.
#pragma once

#include <optional>

#include "outrider/slam/pose_graph.hpp"

namespace outrider::bench {

struct PeerResult {
  double cost = 0.0;    ///< as cost() has it
  double time_s = 0.0;  ///< of the solver alone, without building its problem
  int iterations = 0;
};

/// From the poses given, on one thread, with its sparse Cholesky factorisation, its default tolerances and at
/// most 1000 iterations. Nothing without Ceres, and for graphs with points or ranges.
std::optional<PeerResult> solve_with_ceres(const PoseGraph& graph);

}  // namespace outrider::bench
