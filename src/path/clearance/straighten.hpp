// Few legs in place of a fine path: which of its points to keep.
#pragma once

#include <cstddef>
#include <vector>

namespace outrider {

/// The points, counted from 0, that legs may join, first and last among them; one point is itself.
/// `does(i, j)` says whether the leg from point i may go straight to j > i + 1; the next point always will.
/// From each the far end is tried, then half the way, and so on; what does, is stretched by bisection.
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
