// Eigenvalues and eigenvectors of small symmetric matrices, N = 2 or 3. Eigen's solver takes seconds to
// compile at each size, so one source file has it.
#pragma once

#include <Eigen/Core>

namespace outrider {

template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;   ///< ascending
  Eigen::Matrix<double, N, N> vectors;  ///< by column, of length 1
};

/// Reads only the lower triangle.
template <int N>
SymmetricEigen<N> eigen_of_symmetric(const Eigen::Matrix<double, N, N>& a);

/// Returns A^(-1/2) of a positive definite matrix.
template <int N>
Eigen::Matrix<double, N, N> inverse_square_root(const Eigen::Matrix<double, N, N>& a);

}  // namespace outrider
