#include "laser/keyframe_graph.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "algebra/small_cholesky.hpp"
#include "covariances.hpp"

namespace outrider {

Eigen::Matrix3d in_frame(const Eigen::Matrix3d& of_parent, double heading_rad) {
  const Eigen::Matrix3d turn = rotation_by(heading_rad);
  return turn.transpose() * of_parent * turn;
}

void KeyframeGraph::add_constraint(std::uint32_t from, std::uint32_t to, const Pose2& world_T_to,
                                   const Eigen::Matrix3d& information) {
  const Pose2& start = keyframes[from].pose;
  const Eigen::Matrix3d local = in_frame(information, start.heading_rad);
  KeyframeConstraint added;
  added.edge = {EdgeKind::pose, from, to, relative_pose(start, world_T_to), local};
  add_constraint(added);
}

void KeyframeGraph::add_constraint(const KeyframeConstraint& constraint) {
  constraints_.push_back(constraint);
  add_links(constraint.edge);
}

void KeyframeGraph::add_links(const GraphEdge& edge) {
  const SmallCholesky<3> factor(edge.information);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  if (factor.is_positive()) covariance = factor.inverse();
  constexpr double lever_m = 2.0;  // distance at which a rotation is converted to a displacement
  const double variance = covariance(0, 0) + covariance(1, 1) + lever_m * lever_m * covariance(2, 2);
  links_.resize(keyframes.size());
  links_[edge.from].push_back({edge.to, variance});
  links_[edge.to].push_back({edge.from, variance});
}

void KeyframeGraph::replace(std::vector<KeyframeConstraint> constraints, const std::vector<Pose2>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) keyframes[i].pose = poses[i];
  constraints_ = std::move(constraints);
  links_.clear();
  for (const KeyframeConstraint& constraint : constraints_) add_links(constraint.edge);
  of_last_.forget();
}

void KeyframeGraph::share_last_constraint(const Eigen::Matrix3d& information, const Matched& matched) {
  KeyframeConstraint& last = constraints_.back();
  last.shared = in_frame(information, keyframes[last.edge.from].pose.heading_rad);
  last.matched = matched;
}

void KeyframeGraph::remove_last_constraint(const std::vector<Pose2>& before) {
  for (std::size_t i = 0; i < before.size(); ++i) keyframes[i].pose = before[i];
  const GraphEdge& last = constraints_.back().edge;
  links_[last.from].pop_back();
  links_[last.to].pop_back();
  constraints_.pop_back();
  of_last_.forget();
}

double KeyframeGraph::chi2() const {
  const GraphEdge& edge = constraints_.back().edge;
  const Eigen::Vector3d r = residual(edge, keyframes[edge.from].pose, keyframes[edge.to].pose);
  return r.dot(edge.information * r);
}

PoseGraph KeyframeGraph::pose_graph() const {
  PoseGraph graph;
  for (const Keyframe& key : keyframes) graph.nodes.push_back({{}, key.pose, false});
  for (const KeyframeConstraint& constraint : constraints_) graph.edges.push_back(constraint.edge);
  return graph;
}

bool KeyframeGraph::optimise() {
  PoseGraphOptions options;
  options.start = "given";
  options.kernel = "huber";
  options.iterations = 20;
  options.tolerance = 1e-5;
  const auto solution = outrider::optimise(pose_graph(), options, {});
  if (!solution) return false;
  for (std::size_t i = 0; i < keyframes.size(); ++i) keyframes[i].pose = solution->poses[i];
  of_last_.forget();
  return true;
}

std::vector<Pose2> KeyframeGraph::poses() const {
  std::vector<Pose2> result;
  for (const Keyframe& key : keyframes) result.push_back(key.pose);
  return result;
}

void KeyframeGraph::update_covariance() { covariance_ = of_last_.of_last(keyframes, constraints_); }

std::vector<double> KeyframeGraph::variances_from(std::uint32_t keyframe, double bound) const {
  std::vector<double> variance(keyframes.size(), std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, std::uint32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  variance[keyframe] = 0.0;
  open.push({0.0, keyframe});
  while (!open.empty()) {
    const auto [so_far, at] = open.top();
    open.pop();
    if (so_far > variance[at] || at >= links_.size()) continue;
    for (const Link& link : links_[at]) {
      const double next = so_far + link.variance;
      if (next > bound || next >= variance[link.to]) continue;
      variance[link.to] = next;
      open.push({next, link.to});
    }
  }
  return variance;
}

}  // namespace outrider
