#include "algebra/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace outrider {

template <int N>
SymmetricEigen<N> eigen_of_symmetric(const Eigen::Matrix<double, N, N>& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

template <int N>
Eigen::Matrix<double, N, N> inverse_square_root(const Eigen::Matrix<double, N, N>& a) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>>(a).operatorInverseSqrt();
}

template SymmetricEigen<2> eigen_of_symmetric(const Eigen::Matrix2d&);
template SymmetricEigen<3> eigen_of_symmetric(const Eigen::Matrix3d&);
template Eigen::Matrix2d inverse_square_root(const Eigen::Matrix2d&);
template Eigen::Matrix3d inverse_square_root(const Eigen::Matrix3d&);

}  // namespace outrider
