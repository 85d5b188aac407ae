// A cost below which no poses of a pose graph can be: with it, a solution is proven to be the least, or how
// near.
//
// The bound is for the cost of pose_graph.hpp itself. Each edge has a minorant that is linear in the products
// of the columns of rotations and positions, and touches the cost of the edge at the given poses:
//   - rotations in space: (2 v)^T W (2 v), with v the vector part of a quaternion, is linear in its rotation
//     matrix, so nothing is lost unless one eigenvalue of W exceeds the sum of the others;
//   - headings: a^2 is convex in cos a, so its tangent there is below it;
//   - positions: the part of W above its least eigenvalue is replaced by its tangent plane.
// The least of the sum over all poses is bounded by Lagrangian duality as in SE-Sync (Rosen, Carlone,
// Bandeira and Leonard, IJRR 38 (2019) 95-125, sections 4 and 5): the multipliers follow from the poses, and
// the dual matrix plus a shift is tested for positive definiteness by a sparse Cholesky factorisation. The
// least shift that is found to succeed, times the dimension and the number of poses, is what the proof leaves
// open.
//
// At a global minimum with moderate errors the bound reaches the cost. Elsewhere it does not, and is below
// the least cost all the same: any poses give a valid bound. It holds up to the rounding errors of the
// factorisation. In space, an information that couples position and rotation is bounded by one that does not,
// so that the bound stays below the cost. Errors: bad_input for graphs with ranges, and for what check()
// refuses. Pure function.
#pragma once

#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

/// Returns the bound; not above cost(), to rounding. 0 where nothing better is proven.
template <class Pose>
Outcome<double> least_cost_bound(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses);

}  // namespace outrider
