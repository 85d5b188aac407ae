#include "key_graph.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace outrider {
namespace {

Matrix3 turned(double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {{c, -s, 0, s, c, 0, 0, 0, 1}};
}

}  // namespace

Pose2 between(const Pose2& a, const Pose2& b) {
  return {unrotated(a.heading_rad, b.position - a.position), b.heading_rad - a.heading_rad};
}

Matrix3 in_frame(const Matrix3& of_parent, double heading_rad) {
  const Matrix3 turn = turned(heading_rad);
  return transposed(turn) * of_parent * turn;
}

void KeyGraph::tie(std::uint32_t from, std::uint32_t to, const Pose2& world_T_to,
                   const Matrix3& information) {
  const Pose2& start = keys[from].pose;
  const Matrix3 local = in_frame(information, start.heading_rad);
  edges_.push_back({EdgeKind::pose, from, to, between(start, world_T_to), local});
  const Matrix3 covariance = inverse_of_positive(information).value_or(Matrix3{});
  constexpr double lever_m = 2.0;  // what a turn moves
  const double variance = covariance(0, 0) + covariance(1, 1) + lever_m * lever_m * covariance(2, 2);
  ways_.resize(keys.size());
  ways_[from].push_back({to, variance});
  ways_[to].push_back({from, variance});
  spread_covariance(from, to, covariance);
}

/// That of `to` by way of `from`, where it is less than what is known.
void KeyGraph::spread_covariance(std::uint32_t from, std::uint32_t to, const Matrix3& covariance) {
  const Vec2 arm = keys[to].pose.position - keys[from].pose.position;
  Matrix3 by_from = diagonal<3>({1.0, 1.0, 1.0});
  by_from(0, 2) = -arm.y;
  by_from(1, 2) = arm.x;
  const Matrix3 sum = by_from * keys[from].covariance * transposed(by_from) + covariance;
  const auto size = [](const Matrix3& c) { return c(0, 0) + c(1, 1); };
  Matrix3& known = keys[to].covariance;
  covariance_before_ = known;
  if (size(known) == 0.0 || size(sum) < size(known)) known = sum;
}

void KeyGraph::untie(const std::vector<Pose2>& before) {
  for (std::size_t i = 0; i < before.size(); ++i) keys[i].pose = before[i];
  ways_[edges_.back().from].pop_back();
  ways_[edges_.back().to].pop_back();
  keys[edges_.back().to].covariance = covariance_before_;
  edges_.pop_back();
}

double KeyGraph::tension() const {
  const GraphEdge& edge = edges_.back();
  return quadratic_form(edge.information, residual(edge, keys[edge.from].pose, keys[edge.to].pose));
}

bool KeyGraph::relax() {
  PoseGraph graph;
  for (const KeyScan& key : keys) graph.nodes.push_back({{}, key.pose, false});
  graph.edges = edges_;
  PoseGraphOptions options;
  options.start = "given";
  options.kernel = "huber";
  options.iterations = 20;
  options.tolerance = 1e-5;
  const auto solution = optimise(graph, options, {});
  if (!solution) return false;
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i].pose = solution->poses[i];
  return true;
}

std::vector<Pose2> KeyGraph::poses() const {
  std::vector<Pose2> result;
  for (const KeyScan& key : keys) result.push_back(key.pose);
  return result;
}

std::vector<double> KeyGraph::variances_from(std::uint32_t key, double bound) const {
  std::vector<double> variance(keys.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  variance[key] = 0.0;
  open.push({0.0, key});
  while (!open.empty()) {
    const auto [so_far, at] = open.top();
    open.pop();
    if (so_far > variance[at] || at >= ways_.size()) continue;
    for (const Way& way : ways_[at]) {
      const double next = so_far + way.variance;
      if (next > bound || next >= variance[way.to]) continue;
      variance[way.to] = next;
      open.push({next, way.to});
    }
  }
  return variance;
}

}  // namespace outrider
