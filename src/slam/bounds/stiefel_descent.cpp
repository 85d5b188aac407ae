#include "bounds/stiefel_descent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/symmetric_eigen.hpp"

namespace outrider {

/// Half the cost is what is descended on, so that its gradient is Q X^T.
template <class Pose>
struct StiefelDescent<Pose>::Point {
  Eigen::MatrixXd x;
  std::vector<typename QuadraticForm<Pose>::Small> multipliers;
  Eigen::MatrixXd gradient;  ///< Riemannian
  double value = 0.0;
};

template <class Pose>
struct StiefelDescent<Pose>::Step {
  Eigen::MatrixXd v, hessian_v;
  bool at_border = false;
};

namespace {

double inner(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a.cwiseProduct(b).sum(); }

/// Returns a shift that is small beside the diagonal of the form.
template <class Pose>
double small_shift(const PoseGraphOf<Pose>& graph, const QuadraticForm<Pose>& form) {
  constexpr double share = 1e-7;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) sum += form.matrix().diagonal(i).trace();
  return share * sum / static_cast<double>((dimension<Pose> + 1) * graph.nodes.size());
}

/// Factors the part of the form that is quadratic in positions.
template <class Pose>
BlockCholesky<1> position_factor(const PoseGraphOf<Pose>& graph, const QuadraticForm<Pose>& form) {
  constexpr int D = dimension<Pose>;
  BlockMatrix<1> matrix;
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    matrix.add_node();
    matrix.diagonal(i)(0, 0) = form.matrix().diagonal(i)(D, D);
  }
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    for (const auto& neighbour : form.matrix().neighbours(i)) {
      if (i > neighbour.node) continue;
      matrix.upper_block(matrix.pair(i, neighbour.node))(0, 0) = form.matrix().block(i, neighbour)(D, D);
    }
  }
  BlockCholesky<1> factor;
  factor.begin(least_fill_order(matrix));
  factor.analyse_all(matrix);
  factor.factor_all(matrix);
  return factor;
}

/// Replaces the rotations by the nearest with orthonormal columns.
template <class Pose>
void orthonormalise(const PoseGraphOf<Pose>& graph, Eigen::MatrixXd& x) {
  constexpr int D = dimension<Pose>, B = D + 1;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (graph.nodes[i].is_point) continue;
    auto rotation = x.template middleRows<D>(B * static_cast<Eigen::Index>(i));
    const Eigen::Matrix<double, D, D> gram = rotation * rotation.transpose();
    rotation = (inverse_square_root<D>(gram) * rotation).eval();
  }
}

}  // namespace

template <class Pose>
StiefelDescent<Pose>::StiefelDescent(const PoseGraphOf<Pose>& graph, QuadraticForm<Pose> form)
    : graph_(graph),
      form_(std::move(form)),
      positions_(position_factor(graph, form_)),
      least_shift_(small_shift(graph, form_)),
      preconditioner_(graph, form_.matrix()),
      shift_(least_shift_) {}

template <class Pose>
double StiefelDescent<Pose>::cost(const Eigen::MatrixXd& x) const {
  return form_.constant() + inner(x, form_.times(x));
}

/// Returns the part of v that is tangent to the rotations at x.
template <class Pose>
Eigen::MatrixXd StiefelDescent<Pose>::project(const Eigen::MatrixXd& x, Eigen::MatrixXd v) const {
  constexpr int D = dimension<Pose>, B = D + 1;
  for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
    if (graph_.nodes[i].is_point) continue;
    const Eigen::Index row = B * static_cast<Eigen::Index>(i);
    const auto rotation = x.template middleRows<D>(row);
    const Eigen::Matrix<double, D, D> m = rotation * v.template middleRows<D>(row).transpose();
    v.template middleRows<D>(row) -= 0.5 * (m + m.transpose()) * rotation;
  }
  return v;
}

template <class Pose>
typename StiefelDescent<Pose>::Point StiefelDescent<Pose>::point_at(const Eigen::MatrixXd& x) const {
  const Eigen::MatrixXd qx = form_.times(x);
  return {x, form_.multipliers(x, qx), project(x, qx), 0.5 * (form_.constant() + inner(x, qx))};
}

template <class Pose>
void StiefelDescent<Pose>::retract(Eigen::MatrixXd& x) const {
  constexpr int D = dimension<Pose>, B = D + 1;
  orthonormalise(graph_, x);
  const auto rows = Eigen::seqN(D, static_cast<Eigen::Index>(graph_.nodes.size()), B);
  x(rows, Eigen::all).setZero();
  const Eigen::MatrixXd qx = form_.times(x);
  std::vector<Eigen::Matrix<double, 1, 1>> right(graph_.nodes.size());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    for (std::size_t i = 0; i < right.size(); ++i)
      right[i](0, 0) = -qx(B * static_cast<Eigen::Index>(i) + D, k);
    const auto solved = positions_.solve(right);
    for (std::size_t i = 0; i < right.size(); ++i)
      x(B * static_cast<Eigen::Index>(i) + D, k) = solved[i](0, 0);
  }
}

/// Factors the dual matrix, which is the Hessian but for the projection, with the least shift that will do.
template <class Pose>
void StiefelDescent<Pose>::precondition_at(const Point& at) {
  preconditioner_.replace(form_.minus(at.multipliers));
  shift_ = std::max(least_shift_, 0.01 * shift_);
  while (std::isfinite(shift_) && !preconditioner_.factor(shift_)) shift_ *= 10.0;
}

template <class Pose>
Eigen::MatrixXd StiefelDescent<Pose>::hessian(const Point& at, const Eigen::MatrixXd& v) const {
  constexpr int D = dimension<Pose>, B = D + 1;
  Eigen::MatrixXd result = form_.times(v);
  for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
    const Eigen::Index row = B * static_cast<Eigen::Index>(i);
    result.template middleRows<D>(row) -= at.multipliers[i] * v.template middleRows<D>(row);
  }
  return project(at.x, std::move(result));
}

/// Truncated conjugate gradients in the norm of the preconditioner (Absil, Baker and Gallivan, algorithm 2).
template <class Pose>
typename StiefelDescent<Pose>::Step StiefelDescent<Pose>::truncated_newton(const Point& at,
                                                                           double radius) const {
  constexpr int most = 200;
  constexpr double enough = 0.1;
  const auto precondition = [&](const Eigen::MatrixXd& r) { return project(at.x, preconditioner_.solve(r)); };
  Step step{Eigen::MatrixXd::Zero(at.x.rows(), at.x.cols()), Eigen::MatrixXd::Zero(at.x.rows(), at.x.cols())};
  Eigen::MatrixXd residual = at.gradient, z = precondition(residual), direction = -z;
  double zr = inner(z, residual), length2 = 0.0, along = 0.0, direction2 = zr;
  const double first = residual.norm();
  const double target = first * std::min(enough, first / std::max(1.0, at.value));
  for (int k = 0; k < most && zr > 0.0; ++k) {
    const Eigen::MatrixXd h = hessian(at, direction);
    const double curvature = inner(direction, h), alpha = zr / curvature;
    const double next2 = length2 + 2.0 * alpha * along + alpha * alpha * direction2;
    step.at_border = curvature <= 0.0 || next2 >= radius * radius;
    const double rest = std::sqrt(along * along + direction2 * (radius * radius - length2));
    const double far = step.at_border ? (rest - along) / direction2 : alpha;
    step.v += far * direction;
    step.hessian_v += far * h;
    if (step.at_border) break;
    residual += alpha * h;
    if (residual.norm() <= target) break;
    z = precondition(residual);
    const double beta = inner(z, residual) / zr;
    zr *= beta;
    direction = beta * direction - z;
    along = beta * (along + alpha * direction2);
    direction2 = zr + beta * beta * direction2;
    length2 = next2;
  }
  return step;
}

template <class Pose>
bool StiefelDescent<Pose>::descend(Eigen::MatrixXd& x, double tolerance, std::int64_t& steps,
                                   BudgetMeter& meter) {
  constexpr double least_radius = 1e-12;  // relative to the first
  retract(x);
  Point at = point_at(x);
  precondition_at(at);
  const double widest = std::sqrt(inner(at.gradient, preconditioner_.solve(at.gradient))) + 1e-300;
  double radius = widest;
  while (radius > least_radius * widest) {
    if (steps <= 0 || !meter.spend()) return false;
    --steps;
    const Step step = truncated_newton(at, radius);
    const double promised = -inner(at.gradient, step.v) - 0.5 * inner(step.v, step.hessian_v);
    if (!(promised > tolerance * std::max(at.value, 1e-3))) break;
    Eigen::MatrixXd next = at.x + step.v;
    retract(next);
    const double gain = (at.value - 0.5 * cost(next)) / promised;
    if (!(gain >= 0.25)) {
      radius *= 0.25;
    } else if (gain > 0.75 && step.at_border) {
      radius *= 2.0;
    }
    if (!(gain > 0.1)) continue;
    at = point_at(next);
    precondition_at(at);
  }
  x = at.x;
  return true;
}

template class StiefelDescent<Pose2>;
template class StiefelDescent<Pose3>;

}  // namespace outrider
