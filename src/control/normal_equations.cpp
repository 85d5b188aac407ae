#include "normal_equations.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace outrider {

NormalEquations::NormalEquations(std::size_t unknowns) {
  const auto n = static_cast<Eigen::Index>(unknowns);
  product_.setZero(n, n);
  right_.setZero(n);
}

void NormalEquations::add(const Vector& row, double right) {
  product_ += row * row.transpose();
  right_ += right * row;
  square_ += right * right;
  ++rows_;
}

/// In the basis of eigenvectors of P A^T A P, with the projection P on vectors of mean 0, the equations
/// separate into one for each direction. Directions with eigenvalue zero are not determined.
NormalEquations::Solution NormalEquations::solve_with_mean_zero() const {
  const Eigen::Index n = right_.size();
  Matrix projection = Matrix::Identity(n, n);
  projection.array() -= 1.0 / static_cast<double>(n);
  const Matrix projected = projection * product_ * projection;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(projected);
  const double largest = projected.diagonal().maxCoeff();

  Solution solution{Vector::Zero(n), Vector::Zero(n)};
  Vector variances = Vector::Zero(n);
  double residual_square = square_;
  double degrees = static_cast<double>(rows_);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double value = eigen.eigenvalues()[k];
    const Vector vector = eigen.eigenvectors().col(k);
    if (value > 1e-9 * largest) {
      const double along = vector.dot(right_);
      residual_square -= along * along / value;
      degrees -= 1.0;
      solution.x += along / value * vector;
      variances += vector.cwiseAbs2() / value;
      continue;
    }
    const double mean = vector.mean();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (std::abs(vector[i] - mean) > 1e-6) variances[i] = std::numeric_limits<double>::infinity();
    }
  }
  const double variance = degrees > 0.0 ? std::max(0.0, residual_square) / degrees : 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    solution.deviations[i] = std::isinf(variances[i]) ? variances[i] : std::sqrt(variance * variances[i]);
  }
  return solution;
}

}  // namespace outrider
