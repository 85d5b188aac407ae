#include "graph/trust_region.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double least_cost = 1e-3;  ///< the tolerance is relative to the cost, but not to less than this

double weight_of(const GraphObjective& objective, std::size_t edge) {
  return objective.weights.empty() ? 1.0 : objective.weights[edge];
}

template <class Pose>
std::vector<Pose> moved(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses,
                        const GraphSteps<Pose>& steps) {
  std::vector<Pose> result = poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto position = position_of(poses[i]);
    if (graph.nodes[i].is_point) {
      set_position(result[i], position + steps[i].template head<dimension<Pose>>());
    } else {
      result[i] = retract(poses[i], steps[i]);
    }
  }
  return result;
}

/// Returns a + s b.
template <class Pose>
GraphSteps<Pose> sum(const GraphSteps<Pose>& a, double s, const GraphSteps<Pose>& b) {
  GraphSteps<Pose> result = a;
  for (std::size_t i = 0; i < a.size(); ++i) result[i] += s * b[i];
  return result;
}

/// The path from nowhere over the minimum along steepest descent to the Gauss-Newton step.
template <class Pose>
class Dogleg {
 public:
  explicit Dogleg(const GraphEquations<Pose>& equations) : equations_(equations), newton_(equations.solve()) {
    const GraphSteps<Pose> steepest = equations.steepest();
    const double down = equations.slope(steepest), bend = equations.curvature(steepest);
    cauchy_ = sum<Pose>(steepest, (bend > 0.0 ? down / bend : 0.0) - 1.0, steepest);
    newton_length_ = length(newton_);
    cauchy_length_ = length(cauchy_);
  }

  [[nodiscard]] const GraphSteps<Pose>& newton() const { return newton_; }
  [[nodiscard]] double newton_length() const { return newton_length_; }
  [[nodiscard]] double length(const GraphSteps<Pose>& steps) const {
    return std::sqrt(equations_.inner_product(steps, steps));
  }
  /// Returns the point of the path at that distance, at most the Gauss-Newton step.
  [[nodiscard]] GraphSteps<Pose> step(double radius) const {
    if (newton_length_ <= radius) return newton_;
    if (cauchy_length_ >= radius) return sum<Pose>(cauchy_, radius / cauchy_length_ - 1.0, cauchy_);
    // |c + s d| = radius, with s between 0 and 1
    const GraphSteps<Pose> d = sum<Pose>(newton_, -1.0, cauchy_);
    const double dd = equations_.inner_product(d, d), cd = equations_.inner_product(cauchy_, d);
    const double rest = (radius - cauchy_length_) * (radius + cauchy_length_);
    const double root = std::sqrt(cd * cd + dd * rest);
    const double s = cd > 0.0 ? rest / (cd + root) : (root - cd) / dd;
    return sum<Pose>(cauchy_, s, d);
  }

 private:
  const GraphEquations<Pose>& equations_;
  GraphSteps<Pose> newton_, cauchy_;
  double newton_length_ = 0.0, cauchy_length_ = 0.0;
};

/// Factors the equations, with the least damping that makes them positive definite; false if none does.
template <class Pose>
bool factor(GraphEquations<Pose>& equations) {
  for (double damping = 0.0; damping <= 1.0; damping = std::max(1e-9, 10.0 * damping)) {
    if (equations.factor(damping)) return true;
  }
  return false;
}

/// Takes the step of the dogleg that lowers the cost as its length allows, and sets the radius for the next;
/// false if none does (Nocedal and Wright 2006, algorithm 4.1).
template <class Pose>
bool take_step(const PoseGraphOf<Pose>& graph, const GraphObjective& objective,
               const GraphEquations<Pose>& equations, const Dogleg<Pose>& dogleg, Descent<Pose>& descent) {
  constexpr double least_radius = 1e-9;  // relative to the Gauss-Newton step
  if (descent.radius == 0.0) descent.radius = dogleg.newton_length();
  while (descent.radius > least_radius * dogleg.newton_length()) {
    const GraphSteps<Pose> step = dogleg.step(descent.radius);
    const double length = std::min(descent.radius, dogleg.newton_length());
    std::vector<Pose> next = moved(graph, descent.poses, step);
    const double next_cost = cost(graph, next, objective);
    const double gain = (descent.cost - next_cost) / equations.predicted_decrease(step);
    if (!(gain >= 0.25)) descent.radius = 0.25 * length;
    if (gain > 0.75) descent.radius = std::max(descent.radius, 3.0 * length);
    if (!(gain > 1e-4)) continue;
    descent.poses = std::move(next);
    descent.cost = next_cost;
    return true;
  }
  return false;
}

}  // namespace

template <class Pose>
double cost(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses, const GraphObjective& objective) {
  double sum = 0.0;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& edge = graph.edges[i];
    const PoseVector<Pose> r = residual(edge, poses[edge.from], poses[edge.to]);
    const double s = r.dot(edge.information * r);
    sum += weight_of(objective, i) * robust_loss(objective.kernel, objective.kernel_width, s).value;
  }
  return sum;
}

template <class Pose>
void linearise(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses,
               const GraphObjective& objective, GraphEquations<Pose>& equations) {
  equations.clear();
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& edge = graph.edges[i];
    LinearEdgeOf<Pose> linear = linearise(edge, poses[edge.from], poses[edge.to]);
    const double s = linear.residual.dot(linear.information * linear.residual);
    linear.information *=
        weight_of(objective, i) * robust_loss(objective.kernel, objective.kernel_width, s).weight;
    equations.add(i, linear);
  }
}

template <class Pose>
Descent<Pose> begin_descent(const PoseGraphOf<Pose>& graph, const GraphObjective& objective,
                            std::vector<Pose> start) {
  Descent<Pose> descent;
  descent.cost = cost(graph, start, objective);
  descent.poses = std::move(start);
  return descent;
}

template <class Pose>
bool descend(const PoseGraphOf<Pose>& graph, const GraphObjective& objective, const DescentLimits& limits,
             GraphEquations<Pose>& equations, Descent<Pose>& descent, BudgetMeter& meter) {
  while (descent.iterations < limits.iterations && descent.end == DescentEnd::none) {
    if (!meter.spend()) return false;
    ++descent.iterations;
    linearise(graph, descent.poses, objective, equations);
    if (!factor(equations)) {
      descent.end = DescentEnd::stuck;
      return true;
    }
    const Dogleg<Pose> dogleg(equations);
    const double most = equations.predicted_decrease(dogleg.newton());
    if (most <= limits.tolerance * std::max(descent.cost, least_cost)) {
      descent.end = DescentEnd::converged;
    } else if (!take_step(graph, objective, equations, dogleg, descent)) {
      descent.end = DescentEnd::stuck;
    }
  }
  return true;
}

template double cost(const PoseGraph&, const std::vector<Pose2>&, const GraphObjective&);
template double cost(const PoseGraph3&, const std::vector<Pose3>&, const GraphObjective&);
template void linearise(const PoseGraph&, const std::vector<Pose2>&, const GraphObjective&,
                        GraphEquations<Pose2>&);
template void linearise(const PoseGraph3&, const std::vector<Pose3>&, const GraphObjective&,
                        GraphEquations<Pose3>&);
template Descent<Pose2> begin_descent(const PoseGraph&, const GraphObjective&, std::vector<Pose2>);
template Descent<Pose3> begin_descent(const PoseGraph3&, const GraphObjective&, std::vector<Pose3>);
template bool descend(const PoseGraph&, const GraphObjective&, const DescentLimits&, GraphEquations<Pose2>&,
                      Descent<Pose2>&, BudgetMeter&);
template bool descend(const PoseGraph3&, const GraphObjective&, const DescentLimits&, GraphEquations<Pose3>&,
                      Descent<Pose3>&, BudgetMeter&);

}  // namespace outrider
