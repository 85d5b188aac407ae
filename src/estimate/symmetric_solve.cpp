#include "symmetric_solve.hpp"

#include <Eigen/Cholesky>

namespace outrider {

Eigen::Vector3d solve_symmetric(const Eigen::Matrix3d& a, const Eigen::Vector3d& b) {
  return a.ldlt().solve(b);
}
Vector6d solve_symmetric(const Matrix6d& a, const Vector6d& b) { return a.ldlt().solve(b); }

Eigen::Matrix3d inverse_of_symmetric(const Eigen::Matrix3d& a) {
  return a.ldlt().solve(Eigen::Matrix3d::Identity());
}
Matrix6d inverse_of_symmetric(const Matrix6d& a) { return a.ldlt().solve(Matrix6d::Identity()); }

double determinant_of_symmetric(const Matrix6d& a) { return a.ldlt().vectorD().prod(); }

}  // namespace outrider
