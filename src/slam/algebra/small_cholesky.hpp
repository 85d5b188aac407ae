// The Cholesky factor L of a small symmetric matrix A = L L^T, by loops of fixed length.
//
// Eigen's LLT compiles kernels for large matrices at every size, which costs seconds of compiling in each
// file that uses it, and calls them for small ones. The loops here give the same bits for up to three rows,
// in half the time. Complexity: N^3 / 3 operations to factor, N^2 for each solution.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace outrider {

template <int N>
class SmallCholesky {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  /// Factors a matrix, of which only the lower triangle is read.
  explicit SmallCholesky(const Matrix& a) : l_(a), is_positive_(factor()) {}

  /// Returns true if the matrix is finite and positive definite.
  [[nodiscard]] bool is_positive() const { return is_positive_; }

  /// Returns x with A x = b.
  [[nodiscard]] Vector solve(const Vector& b) const {
    Vector x = b;
    for (int i = 0; i < N; ++i) {
      double sum = 0.0;
      for (int k = 0; k < i; ++k) sum += l_(i, k) * x[k];
      x[i] = (x[i] - sum) / l_(i, i);
    }
    for (int i = N - 1; i >= 0; --i) {
      double sum = 0.0;
      for (int k = i + 1; k < N; ++k) sum += l_(k, i) * x[k];
      x[i] = (x[i] - sum) / l_(i, i);
    }
    return x;
  }

  /// Returns the inverse of L.
  [[nodiscard]] Matrix inverse_of_triangle() const {
    Matrix result = Matrix::Zero();
    for (int j = 0; j < N; ++j) {
      result(j, j) = 1.0 / l_(j, j);
      for (int i = j + 1; i < N; ++i) {
        double sum = 0.0;
        for (int k = j; k < i; ++k) sum += l_(i, k) * result(k, j);
        result(i, j) = -sum * (1.0 / l_(i, i));
      }
    }
    return result;
  }

  /// Returns the inverse of A.
  [[nodiscard]] Matrix inverse() const {
    Matrix result = inverse_of_triangle();
    for (int i = N - 1; i >= 0; --i) {
      for (int j = 0; j < N; ++j) {
        double sum = 0.0;
        for (int k = i + 1; k < N; ++k) sum += l_(k, i) * result(k, j);
        result(i, j) = (result(i, j) - sum) * (1.0 / l_(i, i));
      }
    }
    return result;
  }

 private:
  bool factor() {
    for (int k = 0; k < N; ++k) {
      double sum = 0.0;
      for (int j = 0; j < k; ++j) sum += l_(k, j) * l_(k, j);
      const double squared = l_(k, k) - sum;
      if (!(squared > 0.0) || !std::isfinite(squared)) return false;
      l_(k, k) = std::sqrt(squared);
      for (int i = k + 1; i < N; ++i) {
        double product = 0.0;
        for (int j = 0; j < k; ++j) product += l_(i, j) * l_(k, j);
        l_(i, k) = (l_(i, k) - product) / l_(k, k);
      }
    }
    return true;
  }

  Matrix l_;  ///< the lower triangle; above it stands what A has there
  bool is_positive_;
};

}  // namespace outrider
