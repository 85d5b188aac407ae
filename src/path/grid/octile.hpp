// Lengths on the eight-connected grid, kept exactly as m + sqrt(2) n with whole m and n.
//
// Two such lengths below 1e7 differ by more than 1e-8 or not at all, so the doubles of value() compare
// as the lengths themselves do.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <numbers>

#include "outrider/world/grid.hpp"

namespace outrider {

struct Octile {
  std::int32_t straight = 0;
  std::int32_t diagonal = 0;

  [[nodiscard]] double value() const { return straight + std::numbers::sqrt2 * diagonal; }
  friend Octile operator+(Octile a, Octile b) { return {a.straight + b.straight, a.diagonal + b.diagonal}; }
  friend bool operator==(Octile a, Octile b) = default;
  friend bool operator<(Octile a, Octile b) { return a.value() < b.value(); }
};

/// Returns the length of a shortest path between two vertices without obstacles.
inline Octile octile_distance(Cell a, Cell b) {
  const int dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
  return {std::abs(dx - dy), std::min(dx, dy)};
}

}  // namespace outrider
