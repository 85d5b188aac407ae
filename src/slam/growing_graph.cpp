#include "growing_graph.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

Matrix3 information_of(Matrix3 covariance, EdgeKind kind) {
  constexpr double exact = 1e-12;
  if (kind == EdgeKind::point) covariance(2, 2) = 1.0;
  for (std::size_t k = 0; k < 3; ++k) covariance(k, k) += covariance(k, k) == 0.0 ? exact : 0.0;
  Matrix3 information = inverse_of_positive(covariance).value_or(Matrix3{});
  if (kind == EdgeKind::point) information(2, 2) = 0.0;
  return information;
}

double size(const Block3& step) {
  return std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
}

}  // namespace

GrowingGraph::GrowingGraph(std::string kernel, double kernel_width)
    : kernel_(std::move(kernel)), kernel_width_(kernel_width) {}

std::uint32_t GrowingGraph::add_node(const Pose2& guess, bool is_point) {
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({guess, {}, is_point ? 1 : 0});
  order_.push_back(node);
  matrix_.add_node();
  factor_.append(node);
  edges_of_.emplace_back();
  gradient_.emplace_back();
  changed_.push_back(node);
  return node;
}

void GrowingGraph::add_edge(EdgeKind kind, std::uint32_t from, std::uint32_t to, const Pose2& measured,
                            const Matrix3& covariance) {
  edges_.push_back({static_cast<std::int64_t>(kind), from, to, measured, information_of(covariance, kind)});
  attach(static_cast<std::uint32_t>(edges_.size() - 1));
  changed_.push_back(from);
  changed_.push_back(to);
}

void GrowingGraph::attach(std::uint32_t edge) {
  const auto [from, to] = std::pair(edges_[edge].from, edges_[edge].to);
  edges_of_[from].push_back(edge);
  edges_of_[to].push_back(edge);
  pair_of_.push_back(matrix_.pair(from, to));
  linear_.push_back(linear(edges_[edge]));
}

GraphEdge GrowingGraph::graph_edge(const Edge& edge) const {
  return {static_cast<EdgeKind>(edge.kind), edge.from, edge.to, edge.measured, edge.information};
}

LinearEdge GrowingGraph::linear(const Edge& edge) const {
  LinearEdge result = linearised(graph_edge(edge), nodes_[edge.from].place, nodes_[edge.to].place);
  if (static_cast<EdgeKind>(edge.kind) == EdgeKind::pose) return result;  // odometry keeps its weight
  const double s = quadratic_form(result.information, result.residual);
  result.information = robust_loss(kernel_, kernel_width_, s).weight * result.information;
  return result;
}

/// The rows of a node in the normal equations, from all its edges in their order. The first node is held.
void GrowingGraph::assemble(std::uint32_t node) {
  Matrix3& diagonal = matrix_.diagonal(node);
  diagonal = {};
  gradient_[node] = {};
  if (nodes_[node].is_point != 0) diagonal(2, 2) = 1.0;
  if (node == 0) diagonal = outrider::diagonal<3>({1.0, 1.0, 1.0});
  for (const std::uint32_t edge : edges_of_[node]) matrix_.between(pair_of_[edge]) = {};
  for (const std::uint32_t index : edges_of_[node]) {
    const auto [from, to] = std::pair(edges_[index].from, edges_[index].to);
    const LinearEdge& edge = linear_[index];
    const Matrix3& by = from == node ? edge.by_from : edge.by_to;
    const Matrix3 weighted = transposed(by) * edge.information;
    if (node == 0) continue;
    diagonal += weighted * by;
    const Block3 pull = weighted * edge.residual;
    for (std::size_t k = 0; k < 3; ++k) gradient_[node][k] += pull[k];
    if (from == 0 || to == 0) continue;
    const Matrix3 lower = transposed(from < to ? edge.by_from : edge.by_to) * edge.information;
    matrix_.between(pair_of_[index]) += lower * (from < to ? edge.by_to : edge.by_from);
  }
}

void GrowingGraph::solve() {
  const std::vector<Block3> steps = factor_.solve(gradient_);
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].step = {-steps[i][0], -steps[i][1], -steps[i][2]};
}

void GrowingGraph::update(double threshold) {
  std::vector<std::uint32_t> stale;  // edges
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (!(size(nodes_[node].step) > threshold)) continue;
    nodes_[node].place = estimate(node);
    nodes_[node].step = {};
    stale.insert(stale.end(), edges_of_[node].begin(), edges_of_[node].end());
  }
  std::sort(stale.begin(), stale.end());
  stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
  for (const std::uint32_t edge : stale) {
    linear_[edge] = linear(edges_[edge]);
    changed_.push_back(edges_[edge].from);
    changed_.push_back(edges_[edge].to);
  }
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  for (const std::uint32_t node : changed_) assemble(node);
  factor_.numbers(matrix_, factor_.structure(matrix_, changed_));
  changed_.clear();
  solve();
}

void GrowingGraph::reorder(std::uint32_t last) {
  order_ = least_fill_order(matrix_, std::vector<std::uint32_t>{last});
  factor_.begin(order_);
  factor_.structure_of_all(matrix_);
  factor_.numbers_of_all(matrix_);
}

/// From the nodes, edges and the order alone; false when they do not belong together.
bool GrowingGraph::rebuild() {
  std::vector<std::uint32_t> sorted = order_;
  std::sort(sorted.begin(), sorted.end());
  bool sound = !nodes_.empty() && sorted.size() == nodes_.size();
  for (std::uint32_t i = 0; sound && i < sorted.size(); ++i) sound = sorted[i] == i;
  for (const Edge& edge : edges_) {
    const auto kind = static_cast<EdgeKind>(edge.kind);
    sound = sound && edge.from < nodes_.size() && edge.to < nodes_.size() && edge.from != edge.to &&
            (kind == EdgeKind::pose || kind == EdgeKind::point) && nodes_[edge.from].is_point == 0 &&
            (nodes_[edge.to].is_point != 0) == (kind == EdgeKind::point);
  }
  if (!sound) return false;
  matrix_ = {};
  edges_of_.assign(nodes_.size(), {});
  gradient_.assign(nodes_.size(), {});
  pair_of_.clear();
  linear_.clear();
  changed_.clear();
  for (std::size_t i = 0; i < nodes_.size(); ++i) matrix_.add_node();
  for (std::uint32_t edge = 0; edge < edges_.size(); ++edge) attach(edge);
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) assemble(node);
  factor_.begin(order_);
  factor_.structure_of_all(matrix_);
  return factor_.numbers_of_all(matrix_);
}

void GrowingGraph::settle() {
  constexpr int most = 100;
  constexpr double enough = 1e-8;
  for (int i = 0; i < most; ++i) {
    update(enough);
    const bool still =
        std::all_of(nodes_.begin(), nodes_.end(), [](const Node& node) { return size(node.step) <= enough; });
    if (still) return;
  }
}

Pose2 GrowingGraph::estimate(std::uint32_t node) const {
  return moved(nodes_[node].place, nodes_[node].step);
}

double GrowingGraph::cost() const {
  double sum = 0.0;
  for (const Edge& edge : edges_) {
    const Block3 r = residual(graph_edge(edge), estimate(edge.from), estimate(edge.to));
    sum += quadratic_form(edge.information, r);
  }
  return sum;
}

Matrix3 GrowingGraph::covariance(std::uint32_t node) const {
  return node == 0 ? Matrix3{} : factor_.inverse_diagonal(node);
}

std::vector<Matrix3> GrowingGraph::covariances() const {
  std::vector<Matrix3> result = factor_.inverse_diagonals();
  result.front() = {};
  return result;
}

Matrix2 GrowingGraph::relative_covariance(std::uint32_t pose, std::uint32_t point) const {
  const std::vector<Matrix3> of_pose = factor_.inverse_columns(pose);
  const Matrix3 of_point = factor_.inverse_columns(point)[point];
  const GraphEdge edge{EdgeKind::point, pose, point, {}, {}};
  const LinearEdge seen = linearised(edge, estimate(pose), estimate(point));
  const Matrix3 mixed = seen.by_to * of_pose[point] * transposed(seen.by_from);
  Matrix3 sum = seen.by_to * of_point * transposed(seen.by_to);
  if (pose != 0) sum += seen.by_from * of_pose[pose] * transposed(seen.by_from) + mixed + transposed(mixed);
  return {{sum(0, 0), 0.5 * (sum(0, 1) + sum(1, 0)), 0.5 * (sum(0, 1) + sum(1, 0)), sum(1, 1)}};
}

}  // namespace outrider
