// Poses and covariances as matrices of Eigen, and back.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

#include "outrider/estimate/belief.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

inline Eigen::Vector3d eigen(Vec3 v) { return {v.x, v.y, v.z}; }
inline Eigen::Matrix3d eigen(const Rotation& r) {
  Eigen::Matrix3d m;
  m << eigen(r.axes[0]), eigen(r.axes[1]), eigen(r.axes[2]);
  return m;
}
template <std::size_t n>
Eigen::Matrix<double, static_cast<int>(n), static_cast<int>(n)> eigen(
    const std::array<std::array<double, n>, n>& rows) {
  Eigen::Matrix<double, static_cast<int>(n), static_cast<int>(n)> m;
  for (std::size_t i = 0; i < n * n; ++i) {
    m(static_cast<int>(i / n), static_cast<int>(i % n)) = rows[i / n][i % n];
  }
  return m;
}

inline Vec3 plain(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Rotation plain(const Eigen::Matrix3d& m) {
  return {
      {plain(Eigen::Vector3d(m.col(0))), plain(Eigen::Vector3d(m.col(1))), plain(Eigen::Vector3d(m.col(2)))}};
}
/// The symmetric part of a matrix, by rows.
template <class Matrix, std::size_t n>
void store(const Matrix& m, std::array<std::array<double, n>, n>& rows) {
  for (std::size_t i = 0; i < n * n; ++i) {
    const auto row = static_cast<int>(i / n), column = static_cast<int>(i % n);
    rows[i / n][i % n] = 0.5 * (m(row, column) + m(column, row));
  }
}

/// The matrix of v x.
inline Eigen::Matrix3d crossing(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The rotation about `v` by its length, rad (Rodrigues' formula).
inline Eigen::Matrix3d turning(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  const Eigen::Matrix3d k = crossing(v);
  const double first = angle > 1e-8 ? std::sin(angle) / angle : 1.0;
  const double second = angle > 1e-8 ? (1.0 - std::cos(angle)) / (angle * angle) : 0.5;
  return Eigen::Matrix3d::Identity() + first * k + second * (k * k);
}

}  // namespace outrider
