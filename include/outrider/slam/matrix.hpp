// Small matrices of fixed size, by rows: the covariances, informations and Jacobians of estimation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "outrider/geometry/pose.hpp"

namespace outrider {

template <std::size_t Rows, std::size_t Columns>
struct Matrix {
  std::array<double, Rows * Columns> values{};

  constexpr double& operator()(std::size_t row, std::size_t column) { return values[row * Columns + column]; }
  constexpr double operator()(std::size_t row, std::size_t column) const {
    return values[row * Columns + column];
  }
  friend bool operator==(const Matrix&, const Matrix&) = default;

  constexpr Matrix& operator+=(const Matrix& b) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += b.values[i];
    return *this;
  }
  friend constexpr Matrix operator+(Matrix a, const Matrix& b) { return a += b; }
  friend constexpr Matrix operator*(double s, Matrix a) {
    for (double& value : a.values) value *= s;
    return a;
  }
  friend constexpr Matrix operator-(const Matrix& a, const Matrix& b) { return a + -1.0 * b; }
};

using Matrix2 = Matrix<2, 2>;
using Matrix3 = Matrix<3, 3>;

template <std::size_t N>
constexpr Matrix<N, N> diagonal(const std::array<double, N>& entries) {
  Matrix<N, N> result;
  for (std::size_t i = 0; i < N; ++i) result(i, i) = entries[i];
  return result;
}

template <std::size_t A, std::size_t B, std::size_t C>
constexpr Matrix<A, C> operator*(const Matrix<A, B>& a, const Matrix<B, C>& b) {
  Matrix<A, C> result;
  for (std::size_t i = 0; i < A; ++i) {
    for (std::size_t j = 0; j < C; ++j) {
      for (std::size_t k = 0; k < B; ++k) result(i, j) += a(i, k) * b(k, j);
    }
  }
  return result;
}

template <std::size_t N>
constexpr std::array<double, N> operator*(const Matrix<N, N>& a, const std::array<double, N>& v) {
  std::array<double, N> result{};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) result[i] += a(i, j) * v[j];
  }
  return result;
}

template <std::size_t Rows, std::size_t Columns>
constexpr Matrix<Columns, Rows> transposed(const Matrix<Rows, Columns>& a) {
  Matrix<Columns, Rows> result;
  for (std::size_t i = 0; i < Rows; ++i) {
    for (std::size_t j = 0; j < Columns; ++j) result(j, i) = a(i, j);
  }
  return result;
}

/// Whether all is finite and the two halves are alike but for rounding, which follows the diagonal: turning a
/// diagonal matrix leaves nothing else of them.
template <std::size_t N>
bool symmetric(const Matrix<N, N>& a) {
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double size = std::abs(a(i, i)) + std::abs(a(j, j));
      if (!(std::abs(a(i, j) - a(j, i)) <= rounding * size)) return false;
    }
  }
  return true;
}

/// The lower triangle C with C C^T = a; nothing unless `a`, of which the lower triangle is read, is positive
/// definite.
template <std::size_t N>
std::optional<Matrix<N, N>> cholesky(const Matrix<N, N>& a) {
  Matrix<N, N> c;
  for (std::size_t j = 0; j < N; ++j) {
    double pivot = a(j, j);
    for (std::size_t k = 0; k < j; ++k) pivot -= c(j, k) * c(j, k);
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return std::nullopt;
    c(j, j) = std::sqrt(pivot);
    for (std::size_t i = j + 1; i < N; ++i) {
      double sum = a(i, j);
      for (std::size_t k = 0; k < j; ++k) sum -= c(i, k) * c(j, k);
      c(i, j) = sum / c(j, j);
    }
  }
  return c;
}

/// The inverse of a lower triangle with a diagonal free of zeros.
template <std::size_t N>
Matrix<N, N> inverse_of_lower(const Matrix<N, N>& c) {
  Matrix<N, N> result;
  for (std::size_t j = 0; j < N; ++j) {
    result(j, j) = 1.0 / c(j, j);
    for (std::size_t i = j + 1; i < N; ++i) {
      double sum = 0.0;
      for (std::size_t k = j; k < i; ++k) sum -= c(i, k) * result(k, j);
      result(i, j) = sum / c(i, i);
    }
  }
  return result;
}

/// The inverse of a symmetric matrix; nothing unless it is positive definite.
template <std::size_t N>
std::optional<Matrix<N, N>> inverse_of_positive(const Matrix<N, N>& a) {
  const auto c = cholesky(a);
  if (!c) return std::nullopt;
  const Matrix<N, N> inverse = inverse_of_lower(*c);
  return transposed(inverse) * inverse;
}

/// v^T a v.
template <std::size_t N>
constexpr double quadratic_form(const Matrix<N, N>& a, const std::array<double, N>& v) {
  const std::array<double, N> image = a * v;
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) sum += v[i] * image[i];
  return sum;
}

/// The rotation of the plane by an angle.
inline Matrix2 rotation2(double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {{c, -s, s, c}};
}

}  // namespace outrider
