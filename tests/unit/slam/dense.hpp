// Dense linear algebra by the book, slow and plain: the oracle of the sparse and of the incremental.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace outrider::testing {

using Dense = std::vector<std::vector<double>>;

inline Dense zeros(std::size_t rows, std::size_t columns) {
  return Dense(rows, std::vector<double>(columns, 0.0));
}

/// Gauss and Jordan with the largest pivot of each column.
inline Dense inverse(Dense a) {
  const std::size_t n = a.size();
  Dense result = zeros(n, n);
  for (std::size_t i = 0; i < n; ++i) result[i][i] = 1.0;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t best = c;
    for (std::size_t r = c; r < n; ++r) {
      if (std::abs(a[r][c]) > std::abs(a[best][c])) best = r;
    }
    std::swap(a[c], a[best]);
    std::swap(result[c], result[best]);
    const double pivot = a[c][c];
    for (std::size_t k = 0; k < n; ++k) {
      a[c][k] /= pivot;
      result[c][k] /= pivot;
    }
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double factor = a[r][c];
      for (std::size_t k = 0; k < n; ++k) {
        a[r][k] -= factor * a[c][k];
        result[r][k] -= factor * result[c][k];
      }
    }
  }
  return result;
}

inline Dense product(const Dense& a, const Dense& b) {
  Dense result = zeros(a.size(), b.front().size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      for (std::size_t j = 0; j < b.front().size(); ++j) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

inline Dense transposed(const Dense& a) {
  Dense result = zeros(a.front().size(), a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.front().size(); ++j) result[j][i] = a[i][j];
  }
  return result;
}

}  // namespace outrider::testing
