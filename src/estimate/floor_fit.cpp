#include "floor_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "symmetric_solve.hpp"

namespace outrider {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

constexpr double expectation_weight = 10.0;  // of the prior for the corner error, in degrees of freedom
constexpr int most_steps = 30;

struct Pose {
  Matrix3d rotation;
  Vector3d position;
};

/// The normal equations: half the Hessian of the cost, half its negative gradient, and the cost.
struct Normal {
  Matrix6d matrix = Matrix6d::Zero();
  Vector6d downhill = Vector6d::Zero();
  double cost = 0.0;
};

/// Adds the corners of one tag; returns false if one is not in front of the camera.
bool add_view(Normal& normal, const Pose& robot, const TagView& view, const RobotCamera& mount,
              const LocaliseOptions& options) {
  const Matrix3d camera_R_world = (robot.rotation * to_eigen(mount.robot_T_camera.rotation)).transpose();
  const Vector3d camera = robot.position + robot.rotation * to_eigen(mount.robot_T_camera.position);
  const Vector2d focal(mount.camera.fx, mount.camera.fy);
  Eigen::Matrix<double, 8, 6> jacobian;
  Eigen::Matrix<double, 8, 1> error;
  const auto corners = tag_corners(view.tag->size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d world = to_eigen(view.tag->world_T_tag * corners[i]);
    const Vector3d p = camera_R_world * (world - camera);
    if (!(p.z() > 0.0)) return false;
    const Vec2 ray = ray_through(mount.camera, view.corners_px[i]);
    const Vector2d seen = p.head<2>() / p.z();
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1, 0, -seen.x(), 0, 1, -seen.y();
    by_point = focal.asDiagonal() * by_point * camera_R_world / p.z();
    const auto row = static_cast<Eigen::Index>(2 * i);
    error.segment<2>(row) = focal.cwiseProduct(seen - Vector2d(ray.x, ray.y));
    jacobian.block<2, 3>(row, 0) = -by_point;
    jacobian.block<2, 3>(row, 3) = by_point * skew(world - robot.position);
  }
  const auto by_tag = jacobian.leftCols<3>();
  Matrix8 covariance = options.tag_sigma_m * options.tag_sigma_m * by_tag * by_tag.transpose();
  covariance.diagonal().array() += options.corner_sigma_px * options.corner_sigma_px;
  const Eigen::LLT<Matrix8> weight(covariance);
  weight.matrixL().solveInPlace(jacobian);
  weight.matrixL().solveInPlace(error);
  normal.matrix += jacobian.transpose() * jacobian;
  normal.downhill -= jacobian.transpose() * error;
  normal.cost += error.squaredNorm();
  return true;
}

void add_floor(Normal& normal, const Pose& robot, const LocaliseOptions& options) {
  const Vector3d up = robot.rotation.col(2);
  const Vector3d lean(robot.position.z(), -up.y(), up.x());
  const double height = std::pow(options.floor_sigma_m, -2.0), tilt = std::pow(options.floor_sigma_rad, -2.0);
  const Vector3d weight(height, tilt, tilt);
  normal.matrix.diagonal().segment<3>(2) += weight;
  normal.downhill.segment<3>(2) -= weight.cwiseProduct(lean);
  normal.cost += lean.dot(weight.cwiseProduct(lean));
}

std::optional<Normal> normal_at(const Pose& robot, const std::vector<TagView>& views,
                                const RobotCamera& mount, const LocaliseOptions& options) {
  Normal normal;
  for (const TagView& view : views) {
    if (!add_view(normal, robot, view, mount, options)) return std::nullopt;
  }
  add_floor(normal, robot, options);
  return normal;
}

Pose upright_pose(const Pose2& pose) {
  return {to_eigen(Rotation::from_rpy(0.0, 0.0, pose.heading_rad)), {pose.position.x, pose.position.y, 0.0}};
}

/// Returns the covariance of x, y and heading.
Matrix3d planar_covariance(const Normal& normal, double scale) {
  constexpr std::array<int, 3> kept{0, 1, 5};
  const Matrix6d covariance = scale * inverse_of_symmetric(normal.matrix);
  const Matrix3d planar = covariance(kept, kept);
  return 0.5 * (planar + planar.transpose());
}

}  // namespace

std::optional<PoseBelief> fit_on_floor(const Pose2& start, const std::vector<TagView>& views,
                                       const RobotCamera& robot_camera, const LocaliseOptions& options,
                                       const std::optional<Pose2>& expected) {
  Pose robot = upright_pose(start);
  auto normal = normal_at(robot, views, robot_camera, options);
  if (!normal) return std::nullopt;
  double damping = 1e-6;
  for (int step = 0; step < most_steps && damping < 1e6; ++step) {
    Matrix6d damped = normal->matrix;
    damped.diagonal() *= 1.0 + damping;
    const Vector6d move = solve_symmetric(damped, normal->downhill);
    const Pose moved{exp_so3(move.tail<3>()) * robot.rotation, robot.position + move.head<3>()};
    const auto there = normal_at(moved, views, robot_camera, options);
    if (!there || !(there->cost <= normal->cost)) {
      damping *= 10.0;
      continue;
    }
    damping *= 0.1;
    robot = moved;
    normal = there;
    if (move.squaredNorm() < 1e-18) break;
  }
  const double freedom = 8.0 * static_cast<double>(views.size()) - 3.0;
  const double scale = (expectation_weight + normal->cost) / (expectation_weight + freedom);
  Matrix3d planar = planar_covariance(*normal, scale);
  if (expected) {
    const auto there = normal_at(upright_pose(*expected), views, robot_camera, options);
    const Matrix3d other = there ? planar_covariance(*there, scale) : planar;
    if (other.determinant() > planar.determinant()) planar = other;
  }
  return PoseBelief{
      {{robot.position.x(), robot.position.y()}, std::atan2(robot.rotation(1, 0), robot.rotation(0, 0))},
      planar};
}

}  // namespace outrider
