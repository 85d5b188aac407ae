#include "graph_edges.hpp"

#include <algorithm>

#include "outrider/core/units.hpp"

namespace outrider {

Pose2 composed(const Pose2& from, const Pose2& measured) {
  return {from.position + rotated(from.heading_rad, measured.position),
          wrap_angle(from.heading_rad + measured.heading_rad)};
}

Pose2 moved(const Pose2& pose, const Block3& step) {
  const double turn = step[2];
  const double along = turn == 0.0 ? 1.0 : std::sin(turn) / turn;
  const double across = turn == 0.0 ? 0.0 : (1.0 - std::cos(turn)) / turn;
  const Vec2 straight = {step[0], step[1]};
  return {pose.position + along * straight + across * perpendicular(straight),
          wrap_angle(pose.heading_rad + turn)};
}

Block3 residual(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  const Vec2 between = to.position - from.position;
  if (edge.kind == EdgeKind::range) return {norm(between) - edge.measured.position.x, 0.0, 0.0};
  const Vec2 r = unrotated(from.heading_rad, between) - edge.measured.position;
  if (edge.kind == EdgeKind::point) return {r.x, r.y, 0.0};
  return {r.x, r.y, wrap_angle(to.heading_rad - from.heading_rad - edge.measured.heading_rad)};
}

LinearEdge linearised(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  LinearEdge result{residual(edge, from, to), {}, {}, edge.information};
  if (edge.kind == EdgeKind::range) {
    const Vec2 between = to.position - from.position;
    const double range_m = norm(between);
    const Vec2 along = range_m > 0.0 ? (1.0 / range_m) * between : Vec2{1.0, 0.0};
    result.by_to.values = {along.x, along.y};
    result.by_from = -1.0 * result.by_to;
    return result;
  }
  const Vec2 axis = direction(from.heading_rad);
  const Vec2 seen = unrotated(from.heading_rad, to.position - from.position);
  result.by_from.values = {-axis.x, -axis.y, seen.y, axis.y, -axis.x, -seen.x, 0.0, 0.0, 0.0};
  result.by_to.values = {axis.x, axis.y, 0.0, -axis.y, axis.x, 0.0, 0.0, 0.0, 0.0};
  if (edge.kind == EdgeKind::pose) {
    result.by_from(2, 2) = -1.0;
    result.by_to(2, 2) = 1.0;
  }
  return result;
}

/// The kernels as in Zhang, Image and Vision Computing 15 (1997) 59-76, of s and with the factor 1/2 left
/// out.
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
  gradient_.resize(graph.nodes.size());
  factor_.begin(least_fill_order(matrix_));
  factor_.structure_of_all(matrix_);
}

void GraphEquations::clear(std::size_t of_a_pose, std::size_t of_a_point) {
  std::fill(gradient_.begin(), gradient_.end(), Block3{});
  for (std::uint32_t node = 0; node < matrix_.size(); ++node) {
    Matrix3& diagonal = matrix_.diagonal(node);
    diagonal = {};
    const std::size_t unknowns = node == fixed_ ? 0 : is_point_[node] != 0 ? of_a_point : of_a_pose;
    for (std::size_t k = unknowns; k < 3; ++k) diagonal(k, k) = 1.0;
  }
  for (const std::uint32_t pair : pairs_) matrix_.between(pair) = {};
}

void GraphEquations::add(std::size_t edge, const LinearEdge& linear) {
  const auto [from, to] = ends_[edge];
  const Matrix3 from_weighted = transposed(linear.by_from) * linear.information;
  const Matrix3 to_weighted = transposed(linear.by_to) * linear.information;
  const auto add_to_node = [&](std::uint32_t node, const Matrix3& weighted, const Matrix3& by) {
    if (node == fixed_) return;
    matrix_.diagonal(node) += weighted * by;
    const Block3 pull = weighted * linear.residual;
    for (std::size_t k = 0; k < 3; ++k) gradient_[node][k] += pull[k];
  };
  add_to_node(from, from_weighted, linear.by_from);
  add_to_node(to, to_weighted, linear.by_to);
  if (from == fixed_ || to == fixed_) return;
  matrix_.between(pairs_[edge]) += from < to ? from_weighted * linear.by_to : to_weighted * linear.by_from;
}

std::vector<Block3> GraphEquations::solve(double damping) {
  if (damping > 0.0) {
    for (std::uint32_t node = 0; node < matrix_.size(); ++node) {
      Matrix3& diagonal = matrix_.diagonal(node);
      for (std::size_t k = 0; k < 3; ++k) diagonal(k, k) += damping;
    }
  }
  if (!factor_.numbers_of_all(matrix_)) return {};
  std::vector<Block3> step = factor_.solve(gradient_);
  for (Block3& block : step) block = {-block[0], -block[1], -block[2]};
  return step;
}

double GraphEquations::promised(const std::vector<Block3>& step) const {
  double sum = 0.0;  // -2 g^T x - x^T H x = -g^T x at the solution of H x = -g
  for (std::size_t node = 0; node < step.size(); ++node) {
    for (std::size_t k = 0; k < 3; ++k) sum -= gradient_[node][k] * step[node][k];
  }
  return sum;
}

std::vector<Matrix3> GraphEquations::covariances() {
  return factor_.numbers_of_all(matrix_) ? factor_.inverse_diagonals() : std::vector<Matrix3>();
}

}  // namespace outrider
