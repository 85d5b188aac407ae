// Pose graphs of the plane and of space: poses and points, the measurements between them, and the most likely
// places.
//
// cost = sum over the edges of r^T W r, with W the information of the edge. The residuals:
//   pose to pose   R(a)^T (t(b) - t(a)) - measured position, and the difference of headings, wrapped;
//   pose to point  R(a)^T (p(b) - t(a)) - measured position;
//   range          |t(b) - t(a)| - measured range.
// g2o's files mean the first with its position also turned back by the measured heading; that is the same
// cost with information R W R^T, which in_measured_frame() makes.
//
// optimise() goes down by a trust region (Powell's dogleg) on a sparse block Cholesky factorisation. It
// begins at the poses given, along the odometry, along a spanning tree, or at a chordal relaxation that needs
// no poses (Carlone et al., ICRA 2015, 4597-4604). "best" descends from one start after the other until the
// first end is proven to be the least or two descents end at the same lowest cost, then under robust kernels
// first, then from the top of the Riemannian staircase (Rosen et al., IJRR 38 (2019) 95-125; graphs without
// ranges), and keeps the lowest end. Robust kernels weigh edges down by iteratively reweighted least squares.
//
// In space, the error of a rotation by the angle a about an axis is 2 sin(a/2) along that axis: twice the
// vector part of its quaternion.
//
// With robust "gnc", edges that contradict the others are refused (Yang et al., RA-L 5 (2020) 1127-1134), but
// never the odometry, which are the edges between poses that follow each other in the file.
//
// Guarantees: no descent raises the cost. The end is a local minimum to the tolerance, when `converged`; that
// it is the global one is not proven (pose_graph_bound.hpp can). Same graph and options, same bytes.
// Errors: bad_input for what check() refuses; budget_exhausted (an iteration is an expansion) and cancelled
// only before the first step: afterwards the best so far is returned. Thread rule: pure functions.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

/// Unknowns of a pose: its position, then its rotation.
template <class Pose>
inline constexpr int freedoms = std::is_same_v<Pose, Pose2> ? 3 : 6;
/// Dimension of the plane or of space: unknowns of a point.
template <class Pose>
inline constexpr int dimension = std::is_same_v<Pose, Pose2> ? 2 : 3;
template <class Pose>
using PoseMatrix = Eigen::Matrix<double, freedoms<Pose>, freedoms<Pose>>;

template <class Pose>
struct GraphNodeOf {
  std::string name;
  Pose pose;              ///< of the node in the world; a point has no rotation
  bool is_point = false;  ///< has a position only
  friend bool operator==(const GraphNodeOf&, const GraphNodeOf&) = default;
};

enum class EdgeKind { pose, point, range };

template <class Pose>
struct GraphEdgeOf {
  EdgeKind kind = EdgeKind::pose;
  std::uint32_t from = 0;  ///< node; a pose unless a range
  std::uint32_t to = 0;
  Pose measured;  ///< of `to` in the frame of `from`; a range stands in position.x
  /// 1/m^2, 1/(m rad), 1/rad^2; the upper left part only of a point (positions) and of a range (1 x 1).
  PoseMatrix<Pose> information = PoseMatrix<Pose>::Zero();
  friend bool operator==(const GraphEdgeOf&, const GraphEdgeOf&) = default;
};

template <class Pose>
struct PoseGraphOf {
  std::vector<GraphNodeOf<Pose>> nodes;  ///< the first pose stays where it is
  std::vector<GraphEdgeOf<Pose>> edges;
  friend bool operator==(const PoseGraphOf&, const PoseGraphOf&) = default;
};

using GraphNode = GraphNodeOf<Pose2>;
using GraphEdge = GraphEdgeOf<Pose2>;
using PoseGraph = PoseGraphOf<Pose2>;
using GraphNode3 = GraphNodeOf<Pose3>;
using GraphEdge3 = GraphEdgeOf<Pose3>;
using PoseGraph3 = PoseGraphOf<Pose3>;

// Every function below exists for Pose2 and for Pose3.

/// Refuses a graph without poses or edges, edges to nodes that do not exist or from a node to itself, numbers
/// that are not finite, information that is not positive definite, and a graph that falls apart.
template <class Pose>
Status check(const PoseGraphOf<Pose>& graph);

/// The edges with the error of a position measured in the frame of the measured pose, as g2o does.
template <class Pose>
PoseGraphOf<Pose> in_measured_frame(PoseGraphOf<Pose> graph);

/// Gives the nodes that are not `placed` (one flag for each) a pose from the edges, breadth first from those
/// that are; where none is, the first pose stands at the origin. Refused: a node that no edge but ranges
/// joins.
template <class Pose>
Status place_from_edges(PoseGraphOf<Pose>& graph, std::vector<bool> placed);

struct PoseGraphOptions {
  std::string start = "best";
  std::string kernel = "none";
  double kernel_width = 3.0;
  std::string robust = "none";
  std::int64_t iterations = 1000;
  double tolerance = 1e-9;
};

std::vector<Option> describe(PoseGraphOptions& options);

template <class Pose>
struct PoseGraphSolutionOf {
  std::vector<Pose> poses;  ///< by node
  double cost = 0.0;        ///< without any kernel
  double start_cost = 0.0;
  double robust_cost = 0.0;     ///< with the kernel: what was made least
  std::int64_t iterations = 0;  ///< of all descents
  std::string start;            ///< of the best descent: one of those above but best
  bool converged = false;       ///< the best descent is at a minimum, to the tolerance
  int descents = 0;
  int descents_agreeing = 0;           ///< that ended at the lowest cost; one is enough if it is proven
  std::vector<std::uint32_t> refused;  ///< edges without which the costs are, ascending
};
using PoseGraphSolution = PoseGraphSolutionOf<Pose2>;

template <class Pose>
double cost(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses);

/// Returns the graph without these edges, ascending.
template <class Pose>
PoseGraphOf<Pose> without_edges(PoseGraphOf<Pose> graph, const std::vector<std::uint32_t>& edges);

/// Returns the numbers measured minus the unknowns. If the information matrices are right, the least cost is
/// distributed as chi-square with so many degrees of freedom.
template <class Pose>
double degrees_of_freedom(const PoseGraphOf<Pose>& graph);

template <class Pose>
Outcome<PoseGraphSolutionOf<Pose>> optimise(const PoseGraphOf<Pose>& graph, const PoseGraphOptions& options,
                                            const Budget& budget);

/// The covariance of each node (position and rotation in the world; a point has zeros for its rotation)
/// given the first pose, linearised at `poses`. Refused where the measurements do not determine a node.
template <class Pose>
Outcome<std::vector<PoseMatrix<Pose>>> marginal_covariances(const PoseGraphOf<Pose>& graph,
                                                            const std::vector<Pose>& poses);

}  // namespace outrider
