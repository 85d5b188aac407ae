// nearest_cell(): the cell nearest to a point, among those that serve a purpose.
#pragma once

#include <optional>

#include "outrider/world/grid.hpp"

namespace outrider {

/// Returns the cell for which `good(cell)` whose centre is nearest to the point, within `most_m` of it; of
/// two the first by rows. O(cells within most_m).
template <class Good>
std::optional<Cell> nearest_cell(const GridFrame& frame, Vec2 point, double most_m, Good good) {
  const Cell middle = frame.cell_at(point);
  const int reach = static_cast<int>(most_m / frame.resolution_m) + 1;
  std::optional<Cell> best;
  double least = most_m;
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const Cell cell{x, y};
      if (!frame.contains(cell) || !good(cell)) continue;
      const double away = cell == middle ? 0.0 : distance(frame.centre(cell), point);
      if (away < least || (away == least && !best)) {
        least = away;
        best = cell;
      }
    }
  }
  return best;
}

}  // namespace outrider
