#include "graph_edges.hpp"

#include <algorithm>

#include "outrider/core/units.hpp"

namespace outrider {

Pose2 retract(const Pose2& pose, const Eigen::Vector3d& step) {
  const double turn = step[2];
  const double along = turn == 0.0 ? 1.0 : std::sin(turn) / turn;
  const double across = turn == 0.0 ? 0.0 : (1.0 - std::cos(turn)) / turn;
  const Vec2 straight = {step[0], step[1]};
  return {pose.position + along * straight + across * perpendicular(straight),
          wrap_angle(pose.heading_rad + turn)};
}

Eigen::Vector3d residual(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  if (edge.kind == EdgeKind::range) {
    return {distance(from.position, to.position) - edge.measured.position.x, 0.0, 0.0};
  }
  const Vec2 r = from.to_local(to.position) - edge.measured.position;
  if (edge.kind == EdgeKind::point) return {r.x, r.y, 0.0};
  return {r.x, r.y, wrap_angle(to.heading_rad - from.heading_rad - edge.measured.heading_rad)};
}

LinearEdge linearise(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  LinearEdge result;
  result.residual = residual(edge, from, to);
  result.information = edge.information;
  if (edge.kind == EdgeKind::range) {
    const Vec2 between = to.position - from.position;
    const double range_m = norm(between);
    const Vec2 along = range_m > 0.0 ? (1.0 / range_m) * between : Vec2{1.0, 0.0};
    result.by_to.row(0) << along.x, along.y, 0.0;
    result.by_from.row(0) = -result.by_to.row(0);
    return result;
  }
  const Vec2 axis = direction(from.heading_rad);
  const Vec2 seen = from.to_local(to.position);
  result.by_from.topRows<2>() << -axis.x, -axis.y, seen.y, axis.y, -axis.x, -seen.x;
  result.by_to.topRows<2>() << axis.x, axis.y, 0.0, -axis.y, axis.x, 0.0;
  if (edge.kind == EdgeKind::pose) {
    result.by_from(2, 2) = -1.0;
    result.by_to(2, 2) = 1.0;
  }
  return result;
}

/// Source: Zhang, Image and Vision Computing 15 (1997) 59-76; as functions of s, without the factor 1/2.
Loss robust_loss(std::string_view kernel, double width, double s) {
  const double square = width * width;
  if (kernel == "huber" && s > square) {
    const double root = std::sqrt(s);
    return {2.0 * width * root - square, width / root};
  }
  if (kernel == "cauchy") return {square * std::log1p(s / square), 1.0 / (1.0 + s / square)};
  if (kernel == "geman_mcclure") {
    const double shrink = 1.0 / (1.0 + s / square);
    return {s * shrink, shrink * shrink};
  }
  return {s, 1.0};
}

GraphEquations::GraphEquations(const PoseGraph& graph, std::uint32_t fixed) : fixed_(fixed) {
  for (const GraphNode& node : graph.nodes) {
    matrix_.add_node();
    is_point_.push_back(node.is_point ? 1 : 0);
  }
  for (const GraphEdge& edge : graph.edges) {
    pairs_.push_back(matrix_.pair(edge.from, edge.to));
    ends_.push_back({edge.from, edge.to});
  }
  gradient_.resize(graph.nodes.size(), Eigen::Vector3d::Zero());
  factor_.begin(least_fill_order(matrix_));
  factor_.analyse_all(matrix_);
}

void GraphEquations::clear(int of_a_pose, int of_a_point) {
  std::fill(gradient_.begin(), gradient_.end(), Eigen::Vector3d(Eigen::Vector3d::Zero()));
  for (std::uint32_t node = 0; node < matrix_.size(); ++node) {
    Eigen::Matrix3d& diagonal = matrix_.diagonal(node);
    diagonal.setZero();
    const int unknowns = node == fixed_ ? 0 : is_point_[node] != 0 ? of_a_point : of_a_pose;
    diagonal.diagonal().tail(3 - unknowns).setOnes();
  }
  for (const std::uint32_t pair : pairs_) matrix_.upper_block(pair).setZero();
}

void GraphEquations::add(std::size_t edge, const LinearEdge& linear) {
  const auto [from, to] = ends_[edge];
  const Eigen::Matrix3d from_weighted = linear.by_from.transpose() * linear.information;
  const Eigen::Matrix3d to_weighted = linear.by_to.transpose() * linear.information;
  const auto add_to_node = [&](std::uint32_t node, const Eigen::Matrix3d& weighted,
                               const Eigen::Matrix3d& by) {
    if (node == fixed_) return;
    matrix_.diagonal(node).noalias() += weighted * by;
    gradient_[node].noalias() += weighted * linear.residual;
  };
  add_to_node(from, from_weighted, linear.by_from);
  add_to_node(to, to_weighted, linear.by_to);
  if (from == fixed_ || to == fixed_) return;
  matrix_.upper_block(pairs_[edge]).noalias() +=
      from < to ? from_weighted * linear.by_to : to_weighted * linear.by_from;
}

std::vector<Eigen::Vector3d> GraphEquations::solve(double damping) {
  if (damping > 0.0) {
    for (std::uint32_t node = 0; node < matrix_.size(); ++node) {
      matrix_.diagonal(node).diagonal().array() += damping;
    }
  }
  if (!factor_.factor_all(matrix_)) return {};
  std::vector<Eigen::Vector3d> step = factor_.solve(gradient_);
  for (Eigen::Vector3d& block : step) block = -block;
  return step;
}

double GraphEquations::predicted_decrease(const std::vector<Eigen::Vector3d>& step) const {
  double sum = 0.0;  // -2 g^T x - x^T H x = -g^T x at the solution of H x = -g
  for (std::size_t node = 0; node < step.size(); ++node) sum -= gradient_[node].dot(step[node]);
  return sum;
}

std::vector<Eigen::Matrix3d> GraphEquations::covariances() {
  return factor_.factor_all(matrix_) ? factor_.inverse_diagonals() : std::vector<Eigen::Matrix3d>();
}

}  // namespace outrider
