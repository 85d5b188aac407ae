// Checks of covariance matrices, and the Jacobians of compose() that propagate them.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "outrider/geometry/pose.hpp"

namespace outrider {

/// Returns true if the matrix is finite and symmetric up to rounding errors relative to the diagonal, such as
/// remain after the rotation of a diagonal matrix.
template <int N>
bool is_symmetric(const Eigen::Matrix<double, N, N>& a) {
  constexpr double rounding = 1e-9;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double size = std::abs(a(i, i)) + std::abs(a(j, j));
      if (!(std::abs(a(i, j) - a(j, i)) <= rounding * size)) return false;
    }
  }
  return true;
}

/// Returns the derivative of compose(a_T_b, b_T_c) by b_T_c: rotates x and y of a vector (x, y, heading).
inline Eigen::Matrix3d rotation_by(double heading_rad) {
  const Vec2 x = direction(heading_rad);
  Eigen::Matrix3d result;
  result << x.x, -x.y, 0.0, x.y, x.x, 0.0, 0.0, 0.0, 1.0;
  return result;
}

/// Returns the derivative of compose(a_T_b, b_T_c) by a_T_b; `arm` is the position of c relative to b along
/// the axes of a.
inline Eigen::Matrix3d lever_of(Vec2 arm) {
  Eigen::Matrix3d result;
  result << 1.0, 0.0, -arm.y, 0.0, 1.0, arm.x, 0.0, 0.0, 1.0;
  return result;
}

}  // namespace outrider
