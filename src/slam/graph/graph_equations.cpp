#include "graph/graph_equations.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace outrider {

template <class Pose>
GraphEquations<Pose>::GraphEquations(const PoseGraphOf<Pose>& graph, std::uint32_t fixed) : fixed_(fixed) {
  for (const auto& node : graph.nodes) {
    matrix_.add_node();
    is_point_.push_back(node.is_point ? 1 : 0);
  }
  for (const auto& edge : graph.edges) {
    pairs_.push_back(matrix_.pair(edge.from, edge.to));
    ends_.push_back({edge.from, edge.to});
  }
  gradient_.resize(graph.nodes.size(), PoseVector<Pose>::Zero());
  factor_.begin(least_fill_order(matrix_));
  factor_.analyse_all(matrix_);
}

template <class Pose>
void GraphEquations<Pose>::clear() {
  std::fill(gradient_.begin(), gradient_.end(), PoseVector<Pose>(PoseVector<Pose>::Zero()));
  for (std::uint32_t node = 0; node < matrix_.size(); ++node) {
    auto& diagonal = matrix_.diagonal(node);
    diagonal.setZero();
    const int unknowns = node == fixed_ ? 0 : is_point_[node] != 0 ? dimension<Pose> : freedoms<Pose>;
    diagonal.diagonal().tail(freedoms<Pose> - unknowns).setOnes();
  }
  for (const std::uint32_t pair : pairs_) matrix_.upper_block(pair).setZero();
}

template <class Pose>
void GraphEquations<Pose>::add(std::size_t edge, const LinearEdgeOf<Pose>& linear) {
  const auto [from, to] = ends_[edge];
  const PoseMatrix<Pose> from_weighted = linear.by_from.transpose() * linear.information;
  const PoseMatrix<Pose> to_weighted = linear.by_to.transpose() * linear.information;
  const auto add_to_node = [&](std::uint32_t node, const PoseMatrix<Pose>& weighted,
                               const PoseMatrix<Pose>& by) {
    if (node == fixed_) return;
    matrix_.diagonal(node).noalias() += weighted * by;
    gradient_[node].noalias() += weighted * linear.residual;
  };
  add_to_node(from, from_weighted, linear.by_from);
  add_to_node(to, to_weighted, linear.by_to);
  if (from == fixed_ || to == fixed_) return;
  if (from < to) {
    matrix_.upper_block(pairs_[edge]).noalias() += from_weighted * linear.by_to;
  } else {
    matrix_.upper_block(pairs_[edge]).noalias() += to_weighted * linear.by_from;
  }
}

template <class Pose>
bool GraphEquations<Pose>::factor(double damping) {
  if (damping == 0.0) return factor_.factor_all(matrix_);
  BlockMatrix<freedoms<Pose>> damped = matrix_;
  double largest = 0.0;
  for (std::uint32_t node = 0; node < damped.size(); ++node) {
    largest = std::max(largest, damped.diagonal(node).diagonal().maxCoeff());
  }
  for (std::uint32_t node = 0; node < damped.size(); ++node) {
    damped.diagonal(node).diagonal() *= 1.0 + damping;
    damped.diagonal(node).diagonal().array() += 1e-3 * damping * largest;
  }
  return factor_.factor_all(damped);
}

template <class Pose>
GraphSteps<Pose> GraphEquations<Pose>::solve() const {
  GraphSteps<Pose> steps = factor_.solve(gradient_);
  for (auto& step : steps) step = -step;
  return steps;
}

template <class Pose>
GraphSteps<Pose> GraphEquations<Pose>::steepest() const {
  GraphSteps<Pose> steps(gradient_.size());
  for (std::uint32_t node = 0; node < steps.size(); ++node) {
    steps[node] = -matrix_.diagonal(node).ldlt().solve(gradient_[node]);
  }
  return steps;
}

template <class Pose>
double GraphEquations<Pose>::inner_product(const GraphSteps<Pose>& a, const GraphSteps<Pose>& b) const {
  double sum = 0.0;
  for (std::uint32_t node = 0; node < a.size(); ++node) sum += a[node].dot(matrix_.diagonal(node) * b[node]);
  return sum;
}

template <class Pose>
double GraphEquations<Pose>::slope(const GraphSteps<Pose>& steps) const {
  double sum = 0.0;
  for (std::size_t node = 0; node < steps.size(); ++node) sum -= gradient_[node].dot(steps[node]);
  return sum;
}

template <class Pose>
double GraphEquations<Pose>::curvature(const GraphSteps<Pose>& steps) const {
  double sum = 0.0;
  for (std::uint32_t node = 0; node < steps.size(); ++node) {
    sum += steps[node].dot(matrix_.diagonal(node) * steps[node]);
    for (const auto& neighbour : matrix_.neighbours(node)) {
      if (neighbour.node < node) continue;
      sum += 2.0 * steps[node].dot(matrix_.block(node, neighbour) * steps[neighbour.node]);
    }
  }
  return sum;
}

template <class Pose>
double GraphEquations<Pose>::predicted_decrease(const GraphSteps<Pose>& steps) const {
  return 2.0 * slope(steps) - curvature(steps);
}

template <class Pose>
auto GraphEquations<Pose>::covariances() -> Covariances {
  if (!factor_.factor_all(matrix_)) return {};
  Covariances result = factor_.inverse_blocks(ends_);
  result.diagonals[fixed_].setZero();
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (ends_[i][0] == fixed_ || ends_[i][1] == fixed_) result.pairs[i].setZero();
  }
  return result;
}

template class GraphEquations<Pose2>;
template class GraphEquations<Pose3>;

}  // namespace outrider
