// Straightening: selects the points of a fine path that a few straight legs may join.
#pragma once

#include <cstddef>
#include <vector>

namespace outrider {

/// Returns the indices of the selected points, including the first and the last; a path of one point stays
/// unchanged. `does(i, j)` returns true if a straight leg may go from point i to j > i + 1; a leg to the next
/// point is always allowed. From each point the function tries the last point, then half the distance, and so
/// on; it then extends the successful leg by bisection.
template <class Does>
std::vector<std::size_t> straightened(std::size_t points, Does does) {
  std::vector<std::size_t> kept{0};
  while (kept.back() + 1 < points) {
    const std::size_t from = kept.back();
    std::size_t good = from + 1, bad = points;
    for (std::size_t reach = points - 1 - from; reach > 1; reach = (reach + 1) / 2) {
      if (does(from, from + reach)) {
        good = from + reach;
        break;
      }
      bad = from + reach;
    }
    while (good + 1 < bad) {
      const std::size_t middle = good + (bad - good) / 2;
      (does(from, middle) ? good : bad) = middle;
    }
    kept.push_back(good);
  }
  return kept;
}

}  // namespace outrider
