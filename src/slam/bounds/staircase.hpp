// The Riemannian staircase: poses near the global minimum of a pose graph, from any poses.
//
// Made least is the cost of SE-Sync (Rosen, Carlone, Bandeira and Leonard, IJRR 38 (2019) 95-125), with one
// weight for the position of each edge and one for its rotation, and |R(b) - R(a) M|^2 for the error of a
// rotation M. Its rotations are relaxed to p x D matrices with orthonormal columns, beginning with p = D.
// Where the dual matrix at a stationary point is not positive semidefinite, its least eigenvector is a way
// down in one dimension more (Boumal, Voroninski and Bandeira, NIPS 2016). Where it is, no poses cost less,
// and the rotations are rounded back to D dimensions.
//
// Each step is one of a Riemannian trust region with truncated conjugate gradients (Absil, Baker and
// Gallivan, Found. Comput. Math. 7 (2007) 303-330), preconditioned by a Cholesky factor of the form.
#pragma once

#include "graph/graph_starts.hpp"
#include "outrider/core/budget.hpp"

namespace outrider {

template <class Pose>
struct StaircaseResult {
  std::vector<Pose> poses;      ///< the first is where it was
  std::int64_t iterations = 0;  ///< of the trust region
  int rank = 0;                 ///< p at the end
  bool proven = false;          ///< no poses of any dimension cost less by 1e-4, of the kind above
};

/// Climbs from the poses in at most so many steps, each an expansion. Pre: check() accepts the graph, and it
/// has no ranges.
template <class Pose>
StaircaseResult<Pose> climb_staircase(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses,
                                      std::int64_t iterations, BudgetMeter& meter);

}  // namespace outrider
