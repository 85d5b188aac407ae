#include "normal_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace outrider {
namespace {

using Matrix = double[most_wheels][most_wheels];

/// Eigenvectors (columns of `vectors`) and eigenvalues of a symmetric matrix: cyclic Jacobi rotations.
/// Source: Golub and Van Loan, Matrix Computations, section 8.5.
void eigen(Matrix& a, Matrix& vectors, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) vectors[i][j] = i == j ? 1.0 : 0.0;
  }
  for (int sweep = 0; sweep < 30; ++sweep) {
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) {
        if (a[p][q] == 0.0) continue;
        const double tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = (tau >= 0.0 ? 1.0 : -1.0) / (std::abs(tau) + std::sqrt(1.0 + tau * tau));
        const double c = 1.0 / std::sqrt(1.0 + t * t);
        const double s = t * c;
        for (std::size_t k = 0; k < n; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < n; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          const double vp = vectors[k][p], vq = vectors[k][q];
          vectors[k][p] = c * vp - s * vq;
          vectors[k][q] = s * vp + c * vq;
        }
      }
    }
  }
}

/// P a P with the projection P = I - 1/n on what has mean 0.
void project(const Matrix& a, Matrix& projected, std::size_t n) {
  double rows[most_wheels] = {}, columns[most_wheels] = {}, all = 0.0;
  const double part = 1.0 / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      rows[i] += part * a[i][j];
      columns[j] += part * a[i][j];
      all += part * part * a[i][j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) projected[i][j] = a[i][j] - rows[i] - columns[j] + all;
  }
}

}  // namespace

void NormalEquations::add(const WheelSpeeds4& row, double right) {
  for (std::size_t i = 0; i < unknowns_; ++i) {
    for (std::size_t j = 0; j < unknowns_; ++j) product_[i][j] += row[i] * row[j];
    right_[i] += row[i] * right;
  }
  square_ += right * right;
  ++rows_;
}

NormalEquations::Solution NormalEquations::solve_with_mean_zero() const {
  const std::size_t n = unknowns_;
  Matrix a;
  project(product_, a, n);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, a[i][i]);
  Matrix vectors;
  eigen(a, vectors, n);

  Solution solution;
  WheelSpeeds4 variances{};
  double rest_square = square_;
  double degrees = static_cast<double>(rows_);
  for (std::size_t k = 0; k < n; ++k) {
    const double value = a[k][k];
    double mean = 0.0, along = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      mean += vectors[i][k] / static_cast<double>(n);
      along += vectors[i][k] * right_[i];
    }
    const bool determined = value > 1e-9 * largest;
    if (determined) {
      rest_square -= along * along / value;
      degrees -= 1.0;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (determined) {
        solution.x[i] += vectors[i][k] * along / value;
        variances[i] += vectors[i][k] * vectors[i][k] / value;
      } else if (std::abs(vectors[i][k] - mean) > 1e-6) {
        variances[i] = std::numeric_limits<double>::infinity();
      }
    }
  }
  const double variance = degrees > 0.0 ? std::max(0.0, rest_square) / degrees : 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    solution.deviations[i] = std::isinf(variances[i]) ? variances[i] : std::sqrt(variance * variances[i]);
  }
  return solution;
}

}  // namespace outrider
