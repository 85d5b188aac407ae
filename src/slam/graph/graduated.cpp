#include "graph/graduated.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// Returns r^T W r of each edge, relative to the largest that is plausible.
template <class Pose>
std::vector<double> relative_errors(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses) {
  std::vector<double> result;
  for (const auto& edge : graph.edges) {
    const PoseVector<Pose> r = residual(edge, poses[edge.from], poses[edge.to]);
    result.push_back(r.dot(edge.information * r) / largest_cost(residual_rows<Pose>(edge.kind)));
  }
  return result;
}

double largest_of(const std::vector<double>& errors, const std::vector<bool>& considered) {
  double largest = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (considered[i]) largest = std::max(largest, errors[i]);
  }
  return largest;
}

/// The weight of an edge with r^T W r = s c^2 at the control parameter mu (equation 14).
double weight(double s, double mu) {
  if (s >= (mu + 1.0) / mu) return 0.0;
  if (s <= mu / (mu + 1.0)) return 1.0;
  return std::sqrt(mu * (mu + 1.0) / s) - mu;
}

/// Returns r^T (W^-1 + C)^-1 r; 0 if the sum is not positive definite.
template <class Pose>
double change(const GraphEdgeOf<Pose>& edge, const PoseVector<Pose>& r, const PoseMatrix<Pose>& c) {
  const Eigen::Index rows = residual_rows<Pose>(edge.kind);
  const Eigen::MatrixXd information = edge.information.topLeftCorner(rows, rows);
  const Eigen::MatrixXd covariance = information.llt().solve(Eigen::MatrixXd::Identity(rows, rows));
  const Eigen::LLT<Eigen::MatrixXd> sum(covariance + c.topLeftCorner(rows, rows));
  constexpr double rounding = 1e-9;
  if (sum.info() != Eigen::Success || sum.rcond() < rounding) return 0.0;
  return r.head(rows).dot(sum.solve(r.head(rows)));
}

}  // namespace

template <class Pose>
std::vector<bool> refusable_edges(const PoseGraphOf<Pose>& graph) {
  std::vector<std::uint32_t> place(graph.nodes.size(), 0);  // among the poses
  std::uint32_t poses = 0;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    place[i] = poses;
    poses += graph.nodes[i].is_point ? 0 : 1;
  }
  std::vector<bool> result;
  for (const auto& edge : graph.edges) {
    const auto [first, second] = std::minmax(place[edge.from], place[edge.to]);
    result.push_back(edge.kind != EdgeKind::pose || second != first + 1);
  }
  return result;
}

double largest_cost(double freedom, double deviations) {
  const double spread = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - spread + deviations * std::sqrt(spread), 3);
}

template <class Pose>
std::vector<bool> graduated_refusals(const PoseGraphOf<Pose>& graph, std::vector<Pose>& poses,
                                     std::int64_t iterations, BudgetMeter& meter) {
  constexpr double growth = 1.4;   // of the control parameter, as in section V of the paper
  constexpr std::int64_t few = 4;  // steps at each value of it
  constexpr double roughly = 1e-3;
  const std::vector<bool> refusable = refusable_edges(graph);
  GraphEquations<Pose> equations(graph, first_pose(graph));
  GraphObjective objective;
  objective.weights.assign(graph.edges.size(), 1.0);
  const auto proceed = [&](std::int64_t most) {
    Descent<Pose> descent = begin_descent(graph, objective, std::move(poses));
    const bool goes_on = descend(graph, objective, {most, roughly}, equations, descent, meter);
    poses = std::move(descent.poses);
    return goes_on;
  };
  double mu = 0.0;
  bool settled = false;
  for (bool goes_on = proceed(iterations); goes_on && !settled; goes_on = proceed(few)) {
    const std::vector<double> errors = relative_errors(graph, poses);
    if (mu == 0.0) mu = 1.0 / std::max(1.0, 2.0 * largest_of(errors, refusable) - 1.0);
    settled = true;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (!refusable[i]) continue;
      objective.weights[i] = weight(errors[i], mu);
      settled = settled && (objective.weights[i] == 0.0 || objective.weights[i] == 1.0);
    }
    mu *= growth;
  }
  std::vector<bool> refused;
  for (const double w : objective.weights) refused.push_back(w < 0.5);
  return refused;
}

template <class Pose>
std::vector<double> cost_changes(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses,
                                 const std::vector<bool>& refused) {
  GraphEquations<Pose> equations(graph, first_pose(graph));
  GraphObjective objective;
  for (const bool is_refused : refused) objective.weights.push_back(is_refused ? 0.0 : 1.0);
  linearise(graph, poses, objective, equations);
  const auto [own, joint] = equations.covariances();
  std::vector<double> result(graph.edges.size(), 0.0);
  if (own.empty()) return result;
  const std::vector<bool> refusable = refusable_edges(graph);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!refusable[i]) continue;
    const auto& edge = graph.edges[i];
    const LinearEdgeOf<Pose> linear = linearise(edge, poses[edge.from], poses[edge.to]);
    const PoseMatrix<Pose> mixed = linear.by_from * joint[i] * linear.by_to.transpose();
    const PoseMatrix<Pose> predicted = linear.by_from * own[edge.from] * linear.by_from.transpose() +
                                       linear.by_to * own[edge.to] * linear.by_to.transpose() + mixed +
                                       mixed.transpose();
    result[i] = change(edge, linear.residual, refused[i] ? predicted : PoseMatrix<Pose>(-predicted));
  }
  return result;
}

template std::vector<bool> refusable_edges(const PoseGraph&);
template std::vector<bool> refusable_edges(const PoseGraph3&);
template std::vector<bool> graduated_refusals(const PoseGraph&, std::vector<Pose2>&, std::int64_t,
                                              BudgetMeter&);
template std::vector<bool> graduated_refusals(const PoseGraph3&, std::vector<Pose3>&, std::int64_t,
                                              BudgetMeter&);
template std::vector<double> cost_changes(const PoseGraph&, const std::vector<Pose2>&,
                                          const std::vector<bool>&);
template std::vector<double> cost_changes(const PoseGraph3&, const std::vector<Pose3>&,
                                          const std::vector<bool>&);

}  // namespace outrider
