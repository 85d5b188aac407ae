// Pose graphs of the plane: poses and points, the measurements between them, and the most likely places.
//
// cost = sum over the edges of r^T W r, with W the information of the edge. The residuals:
//   pose to pose   R(a)^T (t(b) - t(a)) - measured position, and the difference of headings, wrapped;
//   pose to point  R(a)^T (p(b) - t(a)) - measured position;
//   range          |t(b) - t(a)| - measured range.
// g2o's files mean the first with its position also turned back by the measured heading; that is the same
// cost with information R W R^T, which in_measured_frame() makes.
//
// optimise() starts from the poses given, from a chordal relaxation that needs none (Carlone et al., ICRA
// 2015, 4597-4604: the linear least squares of the rotations without their constraint, then of the
// positions), or from the cheaper of the two. It goes down by Gauss-Newton steps, damped after Levenberg
// where one fails, on a sparse block Cholesky factorisation. Robust kernels weigh edges down by iteratively
// reweighted least squares.
//
// Guarantees: the cost never rises. The end is a local minimum to the tolerance, when `converged`; that it is
// the global one is not proven. Same graph and options, same bytes.
// Errors: bad_input for what check() refuses; budget_exhausted (an iteration is an expansion) and cancelled
// only before the first step: afterwards the best so far is returned. Thread rule: pure functions.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

struct GraphNode {
  std::string name;
  Pose2 pose;             ///< of the node in the world; a point has heading 0
  bool is_point = false;  ///< has no heading
  friend bool operator==(const GraphNode&, const GraphNode&) = default;
};

enum class EdgeKind { pose, point, range };

struct GraphEdge {
  EdgeKind kind = EdgeKind::pose;
  std::uint32_t from = 0;  ///< node; a pose unless a range
  std::uint32_t to = 0;
  Pose2 measured;  ///< of `to` in the frame of `from`; a range stands in position.x
  /// 1/m^2, 1/(m rad), 1/rad^2; the upper left 2 x 2 of a point, 1 x 1 of a range.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  friend bool operator==(const GraphEdge&, const GraphEdge&) = default;
};

struct PoseGraph {
  std::vector<GraphNode> nodes;  ///< the first pose stays where it is
  std::vector<GraphEdge> edges;
  friend bool operator==(const PoseGraph&, const PoseGraph&) = default;
};

/// Refuses a graph without poses or edges, edges to nodes that do not exist or from a node to itself, numbers
/// that are not finite, information that is not positive definite, and a graph that falls apart.
Status check(const PoseGraph& graph);

/// The edges with the error of a pose measured in the frame of the measured pose, as g2o does.
PoseGraph in_measured_frame(PoseGraph graph);

/// Gives the nodes that are not `placed` (one flag for each) a pose from the edges, breadth first from those
/// that are; where none is, the first pose stands at the origin. Refused: a node that no edge but ranges
/// joins.
Status place_from_edges(PoseGraph& graph, std::vector<bool> placed);

struct PoseGraphOptions {
  std::string start = "best";
  std::string kernel = "none";
  double kernel_width = 3.0;
  std::int64_t iterations = 1000;
  double tolerance = 1e-9;
};

std::vector<Option> describe(PoseGraphOptions& options);

struct PoseGraphSolution {
  std::vector<Pose2> poses;  ///< by node
  double cost = 0.0;         ///< without any kernel
  double start_cost = 0.0;
  double robust_cost = 0.0;  ///< with the kernel: what was made least
  std::int64_t iterations = 0;
  std::string start;  ///< given or chordal
  bool converged = false;
};

double cost(const PoseGraph& graph, const std::vector<Pose2>& poses);

Outcome<PoseGraphSolution> optimise(const PoseGraph& graph, const PoseGraphOptions& options,
                                    const Budget& budget);

/// The covariance of each node (x, y, heading in the world; a point has zeros for its heading) given the
/// first pose, linearised at `poses`. Refused where the measurements do not determine a node.
Outcome<std::vector<Eigen::Matrix3d>> marginal_covariances(const PoseGraph& graph,
                                                           const std::vector<Pose2>& poses);

}  // namespace outrider
