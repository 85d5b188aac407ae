#include "outrider/slam/bounds/pose_graph_bound.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "algebra/symmetric_eigen.hpp"
#include "bounds/quadratic_form.hpp"
#include "graph/graph_edges.hpp"

namespace outrider {
namespace {

/// Adds the tangent of x^T u x at x = r, for u positive semidefinite and x = R(a)^T (t(b) - t(a)) - arm.
template <class Pose, class Vector>
void add_tangent(const Vector& half_gradient, double value, EdgeForm<Pose>& minorant) {
  minorant.pull += half_gradient;
  minorant.constant += value - 2.0 * half_gradient.dot(minorant.arm);
}

/// Adds the minorant of w a^2 + g a for the angle a of the remaining rotation, which is `angle` at the poses:
/// the tangent of a^2 in cos a, and for g a, with d = a - angle, g (angle + sin d) - steep |g| (1 - cos d).
void add_angle(double w, double g, double angle, const Eigen::Matrix2d& measured, EdgeForm<Pose2>& minorant) {
  constexpr double steep = 2.7;  // (d - sin d) / (1 - cos d) is less for |d| up to 3.9
  constexpr double largest = 0.75;
  const double at = std::clamp(angle, -3.0, 3.0);
  const double slope = at == 0.0 ? 1.0 : at / std::sin(at);
  double by_cos = -2.0 * w * slope, by_sin = 0.0;
  minorant.constant += w * (at * at + slope * 2.0 * std::cos(at));
  if (std::abs(angle) <= largest) {
    const double c = std::cos(angle), s = std::sin(angle);
    by_cos += -g * s + steep * std::abs(g) * c;
    by_sin += g * c + steep * std::abs(g) * s;
    minorant.constant += g * angle - steep * std::abs(g);
  } else {
    minorant.constant -= std::abs(g) * pi;
  }
  // cos a = tr(E) / 2 and sin a = tr(J^T E) / 2 with E = M^T R(a)^T R(b) and J the turn by 90 degrees
  Eigen::Matrix2d quarter;
  quarter << 0.0, -1.0, 1.0, 0.0;
  minorant.cross += 0.25 * measured * (by_cos * Eigen::Matrix2d::Identity() + by_sin * quarter);
}

/// Splits an information into `apart`, without the terms that couple position and rotation, and the rest,
/// which is positive semidefinite too: apart is as large a multiple of the diagonal blocks as possible.
template <class Pose>
PoseMatrix<Pose> uncoupled_part(const PoseMatrix<Pose>& information) {
  constexpr int D = dimension<Pose>, K = freedoms<Pose> - D;
  PoseMatrix<Pose> blocks = information;
  blocks.template topRightCorner<D, K>().setZero();
  blocks.template bottomLeftCorner<K, D>().setZero();
  if (blocks == information) return blocks;
  const Eigen::GeneralizedSelfAdjointEigenSolver<PoseMatrix<Pose>> relative(information, blocks);
  return std::max(0.0, relative.eigenvalues().minCoeff()) * blocks;
}

/// Sets arm, spread and the tangent of the position's error for the information `w`.
template <class Pose, class Matrix, class Vector>
void add_position(const Matrix& w, const Vector& r, EdgeForm<Pose>& minorant) {
  minorant.spread = eigen_of_symmetric<dimension<Pose>>(w).values.minCoeff();
  const Vector rest = w * r - minorant.spread * r;
  add_tangent(rest, -rest.dot(r), minorant);
}

EdgeForm<Pose2> minorant_of(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  EdgeForm<Pose2> minorant;
  const Eigen::Vector3d r = residual(edge, from, to);
  minorant.arm = position_of(edge.measured);
  if (edge.kind == EdgeKind::point) {
    add_position<Pose2, Eigen::Matrix2d, Eigen::Vector2d>(edge.information.topLeftCorner<2, 2>(), r.head<2>(),
                                                          minorant);
    return minorant;
  }
  const Eigen::Matrix3d apart = uncoupled_part<Pose2>(edge.information);
  const Eigen::Vector3d rest = (edge.information - apart) * r;
  add_position<Pose2, Eigen::Matrix2d, Eigen::Vector2d>(apart.topLeftCorner<2, 2>(), r.head<2>(), minorant);
  add_tangent(Eigen::Vector2d(rest.head<2>()), -rest.dot(r), minorant);
  add_angle(apart(2, 2), 2.0 * rest[2], r[2], rotation_of(edge.measured), minorant);
  return minorant;
}

/// Lowers the largest eigenvalue to the sum of the others. Beyond that, a reflection would cost less than no
/// error, and the dual cannot tell it from a rotation.
Eigen::Matrix3d without_reflections(const Eigen::Matrix3d& w) {
  const auto [values, axes] = eigen_of_symmetric<3>(w);
  const Eigen::Vector3d axis = axes.col(2);
  return w - std::max(0.0, values[2] - values[1] - values[0]) * axis * axis.transpose();
}

/// 4 v^T W v = tr W + <2 W - tr(W) I, E> with E the remaining rotation and v the vector part of its
/// quaternion.
EdgeForm<Pose3> minorant_of(const GraphEdge3& edge, const Pose3& from, const Pose3& to) {
  EdgeForm<Pose3> minorant;
  const Eigen::Vector3d r = residual(edge, from, to).head<3>();
  minorant.arm = position_of(edge.measured);
  if (edge.kind == EdgeKind::point) {
    add_position<Pose3, Eigen::Matrix3d, Eigen::Vector3d>(edge.information.topLeftCorner<3, 3>(), r,
                                                          minorant);
    return minorant;
  }
  const PoseMatrix<Pose3> apart = uncoupled_part<Pose3>(edge.information);
  add_position<Pose3, Eigen::Matrix3d, Eigen::Vector3d>(apart.topLeftCorner<3, 3>(), r, minorant);
  const Eigen::Matrix3d w = without_reflections(apart.bottomRightCorner<3, 3>());
  minorant.constant += w.trace();
  minorant.cross += 0.5 * rotation_of(edge.measured) * (2.0 * w - w.trace() * Eigen::Matrix3d::Identity());
  return minorant;
}

/// The dual of the sum of the minorants.
template <class Pose>
class DualProblem {
 public:
  static constexpr int D = dimension<Pose>;

  DualProblem(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses) {
    QuadraticForm<Pose> form(graph);
    for (const auto& edge : graph.edges) form.add(edge, minorant_of(edge, poses[edge.from], poses[edge.to]));
    const Eigen::MatrixXd x = columns_of(graph, poses);
    const auto multipliers = form.multipliers(x, form.times(x));
    value_ = form.constant();
    for (const auto& multiplier : multipliers) value_ += multiplier.trace();
    for (const auto& node : graph.nodes) rotations_ += node.is_point ? 0.0 : 1.0;
    form.fix_first_position();
    matrix_.emplace(graph, form.minus(multipliers));
  }
  /// Returns the bound if the dual matrix with its rotations shifted by so much were positive semidefinite.
  [[nodiscard]] double bound(double shift) const { return value_ - shift * D * rotations_; }
  [[nodiscard]] double shift_for(double loss) const { return loss / (D * rotations_); }
  bool is_positive(double shift) { return matrix_->factor(shift); }

 private:
  std::optional<ShiftedMatrix<Pose>> matrix_;
  double value_ = 0.0;
  double rotations_ = 0.0;
};

}  // namespace

template <class Pose>
Outcome<double> least_cost_bound(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses) {
  if (auto ok = check(graph); !ok) return pass_on(ok);
  for (const auto& edge : graph.edges) {
    if (edge.kind == EdgeKind::range) return bad_input("there is no bound for graphs with ranges");
  }
  DualProblem<Pose> dual(graph, poses);
  const double whole = std::max(cost(graph, poses), 1e-3);
  const auto proves = [&](double loss) { return dual.is_positive(dual.shift_for(loss * whole)); };
  constexpr double least = 1e-9, most = 2.0, fine = 1e-4;  // relative losses
  double loss = least;
  while (loss < most && !proves(loss)) loss *= 10.0;
  if (loss >= most) return 0.0;
  for (double factor = std::sqrt(0.1); loss > fine && factor < 0.8; factor = std::sqrt(factor)) {
    if (proves(factor * loss)) loss *= factor;
  }
  return std::max(0.0, dual.bound(dual.shift_for(loss * whole)));
}

template Outcome<double> least_cost_bound(const PoseGraph&, const std::vector<Pose2>&);
template Outcome<double> least_cost_bound(const PoseGraph3&, const std::vector<Pose3>&);

}  // namespace outrider
