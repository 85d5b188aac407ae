// The edges of a pose graph: residuals, Jacobians, robust weights, and the normal equations they add up to.
//
// Unknowns are steps (x, y, heading) along the world's axes. retract() moves a pose by a step along an arc
// that leaves in the direction (x, y) and turns by the heading, so poses that rotate together about one point
// keep their relative poses exactly, however stiff the edges between them. A residual of fewer than three
// numbers is padded with zeros, and so is its information.
#pragma once

#include <string_view>

#include "block_cholesky.hpp"
#include "outrider/slam/pose_graph.hpp"

namespace outrider {

struct LinearEdge {
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();
  Eigen::Matrix3d by_from = Eigen::Matrix3d::Zero();  ///< derivative of the residual by a step of `from`
  Eigen::Matrix3d by_to = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

Eigen::Vector3d residual(const GraphEdge& edge, const Pose2& from, const Pose2& to);
LinearEdge linearise(const GraphEdge& edge, const Pose2& from, const Pose2& to);
Pose2 retract(const Pose2& pose, const Eigen::Vector3d& step);

/// The loss of a robust kernel at s = r^T W r, and its derivative by s: the weight of the edge.
struct Loss {
  double value = 0.0;
  double weight = 1.0;
};
Loss robust_loss(std::string_view kernel, double width, double s);

/// The normal equations H x = -g of a graph whose node `fixed` does not move.
class GraphEquations {
 public:
  GraphEquations(const PoseGraph& graph, std::uint32_t fixed);

  /// Resets all equations to zero, with ones on the diagonal if a node has fewer than three unknowns.
  void clear(int of_a_pose = 3, int of_a_point = 2);
  void add(std::size_t edge, const LinearEdge& linear);
  /// Solves for the steps, by node, with `damping` added to the diagonal; empty if H is singular.
  std::vector<Eigen::Vector3d> solve(double damping);
  /// Returns the decrease of the cost that the linear model predicts for steps of solve().
  [[nodiscard]] double predicted_decrease(const std::vector<Eigen::Vector3d>& step) const;
  /// Factors H and returns the diagonal blocks of its inverse; empty if H is singular.
  std::vector<Eigen::Matrix3d> covariances();

 private:
  std::uint32_t fixed_;
  std::vector<std::uint8_t> is_point_;
  std::vector<std::uint32_t> pairs_;  ///< by edge
  std::vector<std::array<std::uint32_t, 2>> ends_;
  BlockMatrix matrix_;
  std::vector<Eigen::Vector3d> gradient_;
  BlockCholesky factor_;
};

}  // namespace outrider
