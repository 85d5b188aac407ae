#include "graph/graph_edges.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "algebra/small_cholesky.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d result;
  result << 0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0;
  return result;
}

Eigen::Vector3d to_eigen(Vec3 a) { return {a.x, a.y, a.z}; }
Vec3 to_vec(const Eigen::Vector3d& a) { return {a[0], a[1], a[2]}; }

/// Returns the unit quaternion of the rotation that remains when the measured one is taken away, with a
/// positive real part.
Eigen::Quaterniond remaining_rotation(const Pose3& measured, const Pose3& from, const Pose3& to) {
  Eigen::Quaterniond q(
      Eigen::Matrix3d(rotation_of(measured).transpose() * rotation_of(from).transpose() * rotation_of(to)));
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

/// Writes the range from its direction and the positions' derivatives: rows of a linear edge.
template <class Pose>
void linearise_range(LinearEdgeOf<Pose>& linear, const Pose& from, const Pose& to) {
  constexpr int D = dimension<Pose>;
  const Eigen::Matrix<double, D, 1> between = position_of(to) - position_of(from);
  const double range_m = between.norm();
  const auto along = range_m > 0.0 ? Eigen::Matrix<double, D, 1>(between / range_m)
                                   : Eigen::Matrix<double, D, 1>(Eigen::Matrix<double, D, 1>::Unit(0));
  linear.by_to.template topLeftCorner<1, D>() = along.transpose();
  linear.by_from.template topLeftCorner<1, D>() = -along.transpose();
}

}  // namespace

Eigen::Vector2d position_of(const Pose2& pose) { return {pose.position.x, pose.position.y}; }
Eigen::Vector3d position_of(const Pose3& pose) { return to_eigen(pose.position); }

Eigen::Matrix2d rotation_of(const Pose2& pose) {
  const Vec2 x = direction(pose.heading_rad);
  Eigen::Matrix2d result;
  result << x.x, -x.y, x.y, x.x;
  return result;
}

Eigen::Matrix3d rotation_of(const Pose3& pose) {
  Eigen::Matrix3d result;
  for (int k = 0; k < 3; ++k) result.col(k) = to_eigen(pose.rotation.axes[static_cast<std::size_t>(k)]);
  return result;
}

void set_rotation(Pose2& pose, const Eigen::Matrix2d& matrix) {
  pose.heading_rad = std::atan2(matrix(1, 0) - matrix(0, 1), matrix(0, 0) + matrix(1, 1));
}

void set_rotation(Pose3& pose, const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs[2] = -1.0;
  const Eigen::Matrix3d nearest = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  for (int k = 0; k < 3; ++k) pose.rotation.axes[static_cast<std::size_t>(k)] = to_vec(nearest.col(k));
}

void set_position(Pose2& pose, const Eigen::Vector2d& position) {
  pose.position = {position[0], position[1]};
}
void set_position(Pose3& pose, const Eigen::Vector3d& position) { pose.position = to_vec(position); }

Pose2 retract(const Pose2& pose, const Eigen::Vector3d& step) {
  const double turn = step[2];
  const double along = turn == 0.0 ? 1.0 : std::sin(turn) / turn;
  const double across = turn == 0.0 ? 0.0 : (1.0 - std::cos(turn)) / turn;
  const Vec2 straight = {step[0], step[1]};
  return {pose.position + along * straight + across * perpendicular(straight),
          wrap_angle(pose.heading_rad + turn)};
}

/// Exponential of SE(3): Barfoot, State Estimation for Robotics, equations 7.23 and 7.37.
Pose3 retract(const Pose3& pose, const PoseVector<Pose3>& step) {
  const Eigen::Vector3d turn = step.tail<3>(), straight = step.head<3>();
  const double angle = turn.norm();
  Pose3 result = pose;
  if (angle < 1e-12) {
    set_position(result, position_of(pose) + straight);
    return result;
  }
  const Eigen::Vector3d axis = turn / angle;
  const double along = std::sin(angle) / angle;
  const Eigen::Vector3d moved = along * straight + (1.0 - along) * axis.dot(straight) * axis +
                                (1.0 - std::cos(angle)) / angle * axis.cross(straight);
  set_position(result, position_of(pose) + moved);
  const Eigen::Quaterniond turned(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)) *
                                  Eigen::Quaterniond(rotation_of(pose)));
  const Eigen::Matrix3d rotation = turned.normalized().toRotationMatrix();
  for (int k = 0; k < 3; ++k) result.rotation.axes[static_cast<std::size_t>(k)] = to_vec(rotation.col(k));
  return result;
}

Eigen::Vector3d residual(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  if (edge.kind == EdgeKind::range) {
    return {distance(from.position, to.position) - edge.measured.position.x, 0.0, 0.0};
  }
  const Vec2 r = from.to_local(to.position) - edge.measured.position;
  if (edge.kind == EdgeKind::point) return {r.x, r.y, 0.0};
  return {r.x, r.y, wrap_angle(to.heading_rad - from.heading_rad - edge.measured.heading_rad)};
}

PoseVector<Pose3> residual(const GraphEdge3& edge, const Pose3& from, const Pose3& to) {
  PoseVector<Pose3> result = PoseVector<Pose3>::Zero();
  if (edge.kind == EdgeKind::range) {
    result[0] = norm(to.position - from.position) - edge.measured.position.x;
    return result;
  }
  result.head<3>() = to_eigen(from.to_local(to.position) - edge.measured.position);
  if (edge.kind == EdgeKind::pose) result.tail<3>() = 2.0 * remaining_rotation(edge.measured, from, to).vec();
  return result;
}

LinearEdge linearise(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  LinearEdge result;
  result.residual = residual(edge, from, to);
  result.information = edge.information;
  if (edge.kind == EdgeKind::range) {
    linearise_range(result, from, to);
    return result;
  }
  const Vec2 axis = direction(from.heading_rad);
  const Vec2 seen = from.to_local(to.position);
  result.by_from.topRows<2>() << -axis.x, -axis.y, seen.y, axis.y, -axis.x, -seen.x;
  result.by_to.topRows<2>() << axis.x, axis.y, 0.0, -axis.y, axis.x, 0.0;
  if (edge.kind == EdgeKind::pose) {
    result.by_from(2, 2) = -1.0;
    result.by_to(2, 2) = 1.0;
  }
  return result;
}

/// A turn of `to` by w multiplies the remaining quaternion (q, v) by (1, R(to)^T w / 2) from the right, so 2
/// v grows by (q + [v]x) R(to)^T w.
LinearEdgeOf<Pose3> linearise(const GraphEdge3& edge, const Pose3& from, const Pose3& to) {
  LinearEdgeOf<Pose3> result;
  result.information = edge.information;
  if (edge.kind == EdgeKind::range) {
    result.residual = residual(edge, from, to);
    linearise_range(result, from, to);
    return result;
  }
  const Eigen::Matrix3d back = rotation_of(from).transpose();
  const Eigen::Vector3d between = to_eigen(to.position - from.position);
  result.residual.head<3>() = back * between - to_eigen(edge.measured.position);
  result.by_from.topLeftCorner<3, 3>() = -back;
  result.by_from.topRightCorner<3, 3>() = back * cross_matrix(between);
  result.by_to.topLeftCorner<3, 3>() = back;
  if (edge.kind == EdgeKind::pose) {
    const Eigen::Quaterniond q = remaining_rotation(edge.measured, from, to);
    result.residual.tail<3>() = 2.0 * q.vec();
    result.by_to.bottomRightCorner<3, 3>() =
        (q.w() * Eigen::Matrix3d::Identity() + cross_matrix(q.vec())) * rotation_of(to).transpose();
    result.by_from.bottomRightCorner<3, 3>() = -result.by_to.bottomRightCorner<3, 3>();
  }
  return result;
}

template <class Pose>
double rotation_weight(const GraphEdgeOf<Pose>& edge) {
  constexpr int K = freedoms<Pose> - dimension<Pose>;
  const Eigen::Matrix<double, K, K> part = edge.information.template bottomRightCorner<K, K>();
  const SmallCholesky<K> factor(part);
  if constexpr (K == 1) {
    return 1.0 / factor.solve(part.Ones())[0];
  } else {
    return K / factor.inverse().trace();
  }
}
template double rotation_weight(const GraphEdge&);
template double rotation_weight(const GraphEdge3&);

/// Source: Zhang, Image and Vision Computing 15 (1997) 59-76; as functions of s, without the factor 1/2.
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

}  // namespace outrider
