#include <algorithm>

#include "algebra/block_cholesky.hpp"
#include "graph/graph_edges.hpp"
#include "graph/graph_starts.hpp"

namespace outrider {
namespace {

template <class Pose>
using Small = Eigen::Matrix<double, dimension<Pose>, dimension<Pose>>;
template <class Pose>
using Short = Eigen::Matrix<double, dimension<Pose>, 1>;

/// The linear equations of vectors, one for each node; that of `fixed` is known.
template <class Pose>
class VectorEquations {
 public:
  VectorEquations(const PoseGraphOf<Pose>& graph, std::uint32_t fixed, EdgeKind most) : fixed_(fixed) {
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) matrix_.add_node();
    for (const auto& edge : graph.edges) {
      pairs_.push_back(edge.kind <= most ? matrix_.pair(edge.from, edge.to) : 0);
    }
    matrix_.diagonal(fixed).setIdentity();
  }
  Small<Pose>& diagonal(std::uint32_t node) { return matrix_.diagonal(node); }
  /// Adds |by_from x(from) + by_to x(to)|^2 weighted.
  void add(std::size_t index, const GraphEdgeOf<Pose>& edge, const Small<Pose>& by_from,
           const Small<Pose>& by_to, const Small<Pose>& weight) {
    if (edge.from != fixed_) matrix_.diagonal(edge.from) += by_from.transpose() * weight * by_from;
    if (edge.to != fixed_) matrix_.diagonal(edge.to) += by_to.transpose() * weight * by_to;
    if (edge.from == fixed_ || edge.to == fixed_) return;
    const Small<Pose> block = by_from.transpose() * weight * by_to;
    if (edge.from < edge.to) {
      matrix_.upper_block(pairs_[index]) += block;
    } else {
      matrix_.upper_block(pairs_[index]) += block.transpose();
    }
  }
  bool factor() {
    factor_.begin(least_fill_order(matrix_));
    factor_.analyse_all(matrix_);
    return factor_.factor_all(matrix_);
  }
  std::vector<Short<Pose>> solve(const std::vector<Short<Pose>>& b) const { return factor_.solve(b); }

 private:
  std::uint32_t fixed_;
  std::vector<std::uint32_t> pairs_;
  BlockMatrix<dimension<Pose>> matrix_;
  BlockCholesky<dimension<Pose>> factor_;
};

/// Sets the rotations that minimise the sum of w |R(b)^T - M^T R(a)^T|^2 without their constraint, and then
/// the nearest ones; false if the edges do not determine them.
template <class Pose>
bool relax_rotations(const PoseGraphOf<Pose>& graph, std::uint32_t first, std::vector<Pose>& poses) {
  constexpr int D = dimension<Pose>;
  VectorEquations<Pose> equations(graph, first, EdgeKind::pose);
  std::vector<Small<Pose>> right(poses.size(), Small<Pose>::Zero());  // by node: D right-hand sides
  const Small<Pose> known = rotation_of(poses[first]).transpose();
  right[first] = known;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& edge = graph.edges[i];
    if (edge.kind != EdgeKind::pose) continue;
    const Small<Pose> turn = rotation_of(edge.measured);
    const double weight = rotation_weight(edge);
    equations.add(i, edge, -turn.transpose(), Small<Pose>::Identity(), weight * Small<Pose>::Identity());
    if (edge.from == first) right[edge.to] += weight * turn.transpose() * known;
    if (edge.to == first) right[edge.from] += weight * turn * known;
  }
  for (std::uint32_t node = 0; node < poses.size(); ++node) {
    if (graph.nodes[node].is_point) equations.diagonal(node).setIdentity();
  }
  if (!equations.factor()) return false;
  std::vector<Small<Pose>> transposed(poses.size());
  std::vector<Short<Pose>> column(poses.size());
  for (Eigen::Index k = 0; k < D; ++k) {
    for (std::size_t i = 0; i < poses.size(); ++i) column[i] = right[i].col(k);
    const auto solved = equations.solve(column);
    for (std::size_t i = 0; i < poses.size(); ++i) transposed[i].col(k) = solved[i];
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!graph.nodes[i].is_point && i != first) set_rotation(poses[i], transposed[i].transpose());
  }
  return true;
}

/// Sets the positions that minimise the cost of the position errors for the present rotations.
template <class Pose>
bool relax_positions(const PoseGraphOf<Pose>& graph, std::uint32_t first, std::vector<Pose>& poses) {
  constexpr int D = dimension<Pose>;
  VectorEquations<Pose> equations(graph, first, EdgeKind::point);
  std::vector<Short<Pose>> right(poses.size(), Short<Pose>::Zero());
  const Short<Pose> known = position_of(poses[first]);
  right[first] = known;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& edge = graph.edges[i];
    if (edge.kind == EdgeKind::range) continue;
    const Small<Pose> back = rotation_of(poses[edge.from]).transpose();
    const Small<Pose> weight = edge.information.template topLeftCorner<D, D>();
    equations.add(i, edge, -back, back, weight);
    const Small<Pose> in_world = back.transpose() * weight * back;
    const Short<Pose> pull = back.transpose() * weight * position_of(edge.measured);
    if (edge.from != first) right[edge.from] -= pull;
    if (edge.to != first) right[edge.to] += pull;
    if (edge.from == first) right[edge.to] += in_world * known;
    if (edge.to == first) right[edge.from] += in_world * known;
  }
  if (!equations.factor()) return false;
  const auto solved = equations.solve(right);
  for (std::size_t i = 0; i < poses.size(); ++i) set_position(poses[i], solved[i]);
  return true;
}

}  // namespace

template <class Pose>
Outcome<std::vector<Pose>> chordal_poses(const PoseGraphOf<Pose>& graph) {
  const std::uint32_t first = first_pose(graph);
  std::vector<Pose> poses;
  for (const auto& node : graph.nodes) poses.push_back(node.pose);
  if (relax_rotations(graph, first, poses) && relax_positions(graph, first, poses)) return poses;
  return bad_input("relative poses alone do not join all poses; take the start given", "start");
}

template Outcome<std::vector<Pose2>> chordal_poses(const PoseGraph&);
template Outcome<std::vector<Pose3>> chordal_poses(const PoseGraph3&);

}  // namespace outrider
