// The edges of a graph about a point: residual, Jacobians, weight.
//
// A step (x, y, heading) moves a pose along the arc that leaves it in the direction (x, y) of the world and
// turns by the heading on the way. So poses that turn together about one point keep their places in each
// other's frames exactly, however stiff the edges between them. A residual with fewer than three numbers has
// zeros in the rest, and so has its information.
#pragma once

#include <string_view>

#include "block_cholesky.hpp"
#include "outrider/slam/pose_graph.hpp"

namespace outrider {

struct LinearEdge {
  Block3 residual{};
  Matrix3 by_from;  ///< derivative of the residual
  Matrix3 by_to;
  Matrix3 information;
};

Block3 residual(const GraphEdge& edge, const Pose2& from, const Pose2& to);
LinearEdge linearised(const GraphEdge& edge, const Pose2& from, const Pose2& to);
Pose2 moved(const Pose2& pose, const Block3& step);
/// placed_in() with the heading wrapped.
Pose2 composed(const Pose2& from, const Pose2& measured);

/// What a kernel makes of s = r^T W r: the loss, and its derivative by s, the weight of the edge.
struct Loss {
  double value = 0.0;
  double weight = 1.0;
};
Loss robust_loss(std::string_view kernel, double width, double s);

/// The normal equations H x = -g of a graph with the nodes `fixed` held.
class GraphEquations {
 public:
  GraphEquations(const PoseGraph& graph, std::uint32_t fixed);

  /// Zeros, and ones on the diagonal where a node has fewer unknowns than three.
  void clear(std::size_t of_a_pose = 3, std::size_t of_a_point = 2);
  void add(std::size_t edge, const LinearEdge& linear);
  /// The steps by node with `damping` added to the diagonal; empty when singular.
  std::vector<Block3> solve(double damping);
  /// The decrease of the cost that a step of solve() promises in the linear model.
  [[nodiscard]] double promised(const std::vector<Block3>& step) const;
  /// Factors H and gives the diagonal blocks of its inverse; empty when singular.
  std::vector<Matrix3> covariances();

 private:
  std::uint32_t fixed_;
  std::vector<std::uint8_t> is_point_;
  std::vector<std::uint32_t> pairs_;  ///< by edge
  std::vector<std::array<std::uint32_t, 2>> ends_;
  BlockMatrix matrix_;
  std::vector<Block3> gradient_;
  BlockCholesky factor_;
};

}  // namespace outrider
