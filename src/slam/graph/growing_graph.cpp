#include "graph/growing_graph.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/small_cholesky.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

Eigen::Matrix3d information_of(Eigen::Matrix3d covariance, EdgeKind kind) {
  constexpr double exact = 1e-12;
  if (kind == EdgeKind::point) covariance(2, 2) = 1.0;
  for (Eigen::Index k = 0; k < 3; ++k) covariance(k, k) += covariance(k, k) == 0.0 ? exact : 0.0;
  const SmallCholesky<3> factor(covariance);
  if (!factor.is_positive()) return Eigen::Matrix3d::Zero();
  Eigen::Matrix3d information = factor.inverse();
  if (kind == EdgeKind::point) information(2, 2) = 0.0;
  return information;
}

double size(const Eigen::Vector3d& step) { return step.lpNorm<Eigen::Infinity>(); }

}  // namespace

GrowingGraph::GrowingGraph(std::string kernel, double kernel_width)
    : kernel_(std::move(kernel)), kernel_width_(kernel_width) {}

std::uint32_t GrowingGraph::add_node(const Pose2& guess, bool is_point) {
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({guess, Eigen::Vector3d::Zero(), is_point ? 1 : 0});
  order_.push_back(node);
  matrix_.add_node();
  factor_.append(node);
  edges_of_.emplace_back();
  gradient_.push_back(Eigen::Vector3d::Zero());
  changed_.push_back(node);
  return node;
}

void GrowingGraph::add_edge(EdgeKind kind, std::uint32_t from, std::uint32_t to, const Pose2& measured,
                            const Eigen::Matrix3d& covariance) {
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
  LinearEdge result = linearise(graph_edge(edge), nodes_[edge.from].place, nodes_[edge.to].place);
  if (static_cast<EdgeKind>(edge.kind) == EdgeKind::pose) return result;  // odometry keeps its weight
  const double s = result.residual.dot(result.information * result.residual);
  result.information *= robust_loss(kernel_, kernel_width_, s).weight;
  return result;
}

/// Assembles the rows of a node in the normal equations from its edges, in their order. PoseNode 0 is fixed.
void GrowingGraph::assemble(std::uint32_t node) {
  Eigen::Matrix3d& diagonal = matrix_.diagonal(node);
  diagonal.setZero();
  gradient_[node].setZero();
  if (nodes_[node].is_point != 0) diagonal(2, 2) = 1.0;
  if (node == 0) diagonal.setIdentity();
  for (const std::uint32_t edge : edges_of_[node]) matrix_.upper_block(pair_of_[edge]).setZero();
  for (const std::uint32_t index : edges_of_[node]) {
    const auto [from, to] = std::pair(edges_[index].from, edges_[index].to);
    const LinearEdge& edge = linear_[index];
    const Eigen::Matrix3d& by = from == node ? edge.by_from : edge.by_to;
    const Eigen::Matrix3d weighted = by.transpose() * edge.information;
    if (node == 0) continue;
    diagonal.noalias() += weighted * by;
    gradient_[node].noalias() += weighted * edge.residual;
    if (from == 0 || to == 0) continue;
    const Eigen::Matrix3d lower = (from < to ? edge.by_from : edge.by_to).transpose() * edge.information;
    matrix_.upper_block(pair_of_[index]).noalias() += lower * (from < to ? edge.by_to : edge.by_from);
  }
}

void GrowingGraph::solve() {
  const std::vector<Eigen::Vector3d> steps = factor_.solve(gradient_);
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].step = -steps[i];
}

void GrowingGraph::update(double threshold) {
  std::vector<std::uint32_t> stale;  // edges
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (!(size(nodes_[node].step) > threshold)) continue;
    nodes_[node].place = estimate(node);
    nodes_[node].step.setZero();
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
  factor_.factor(matrix_, factor_.analyse(matrix_, changed_));
  changed_.clear();
  solve();
}

void GrowingGraph::reorder(std::uint32_t last) {
  order_ = least_fill_order(matrix_, std::vector<std::uint32_t>{last});
  factor_.begin(order_);
  factor_.analyse_all(matrix_);
  factor_.factor_all(matrix_);
}

/// Restores all other data from nodes, edges and order; returns false if they are inconsistent.
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
  gradient_.assign(nodes_.size(), Eigen::Vector3d::Zero());
  pair_of_.clear();
  linear_.clear();
  changed_.clear();
  for (std::size_t i = 0; i < nodes_.size(); ++i) matrix_.add_node();
  for (std::uint32_t edge = 0; edge < edges_.size(); ++edge) attach(edge);
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) assemble(node);
  factor_.begin(order_);
  factor_.analyse_all(matrix_);
  return factor_.factor_all(matrix_);
}

void GrowingGraph::settle() {
  constexpr int most = 100;
  constexpr double enough = 1e-8;
  for (int i = 0; i < most; ++i) {
    update(enough);
    const bool still = std::all_of(nodes_.begin(), nodes_.end(),
                                   [](const PoseNode& node) { return size(node.step) <= enough; });
    if (still) return;
  }
}

Pose2 GrowingGraph::estimate(std::uint32_t node) const {
  return retract(nodes_[node].place, nodes_[node].step);
}

std::int64_t GrowingGraph::degrees_of_freedom() const {
  std::int64_t values = 3;  // the first node is fixed
  for (const Edge& edge : edges_) values += edge.kind == static_cast<std::int64_t>(EdgeKind::pose) ? 3 : 2;
  for (const PoseNode& node : nodes_) values -= node.is_point != 0 ? 2 : 3;
  return values;
}

double GrowingGraph::cost() const {
  double sum = 0.0;
  for (const Edge& edge : edges_) {
    const Eigen::Vector3d r = residual(graph_edge(edge), estimate(edge.from), estimate(edge.to));
    sum += r.dot(edge.information * r);
  }
  return sum;
}

Eigen::Matrix3d GrowingGraph::covariance(std::uint32_t node) const {
  return node == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Zero()) : factor_.inverse_diagonal(node);
}

std::vector<Eigen::Matrix3d> GrowingGraph::covariances() const {
  std::vector<Eigen::Matrix3d> result = factor_.inverse_blocks({}).diagonals;
  result.front().setZero();
  return result;
}

Eigen::Matrix2d GrowingGraph::relative_covariance(std::uint32_t pose, std::uint32_t point) const {
  const std::vector<Eigen::Matrix3d> of_pose = factor_.inverse_columns(pose);
  const Eigen::Matrix3d of_point = factor_.inverse_columns(point)[point];
  const GraphEdge edge{EdgeKind::point, pose, point, {}};
  const LinearEdge seen = linearise(edge, estimate(pose), estimate(point));
  const Eigen::Matrix3d mixed = seen.by_to * of_pose[point] * seen.by_from.transpose();
  Eigen::Matrix3d sum = seen.by_to * of_point * seen.by_to.transpose();
  if (pose != 0) sum += seen.by_from * of_pose[pose] * seen.by_from.transpose() + mixed + mixed.transpose();
  return 0.5 * (sum + sum.transpose()).topLeftCorner<2, 2>();
}

}  // namespace outrider
