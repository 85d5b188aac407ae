// Conversions of vectors and rotations to Eigen and back, and rotation vectors.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "outrider/geometry/pose.hpp"

namespace outrider {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

inline Eigen::Vector3d to_eigen(Vec3 v) { return {v.x, v.y, v.z}; }
inline Eigen::Matrix3d to_eigen(const Rotation& r) {
  Eigen::Matrix3d m;
  m << to_eigen(r.axes[0]), to_eigen(r.axes[1]), to_eigen(r.axes[2]);
  return m;
}
inline Vec3 to_vec3(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Rotation to_rotation(const Eigen::Matrix3d& m) {
  return {{to_vec3(m.col(0)), to_vec3(m.col(1)), to_vec3(m.col(2))}};
}

/// Returns the skew-symmetric matrix with skew(v) * w = v x w.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Computes the exponential map of SO(3): the rotation about `v` by its length, rad (Rodrigues' formula).
inline Eigen::Matrix3d exp_so3(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  const Eigen::Matrix3d k = skew(v);
  const double first = angle > 1e-8 ? std::sin(angle) / angle : 1.0;
  const double second = angle > 1e-8 ? (1.0 - std::cos(angle)) / (angle * angle) : 0.5;
  return Eigen::Matrix3d::Identity() + first * k + second * (k * k);
}

}  // namespace outrider
