// Values of the cells of a grid, in another frame on the same lattice.
#pragma once

#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// What was cell c is now c + shift; the new cells are empty.
template <class T>
void move_cells(std::vector<T>& cells, const GridFrame& from, const GridFrame& to, Cell shift, T empty) {
  std::vector<T> moved(to.size(), empty);
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      const Cell there{x + shift.x, y + shift.y};
      if (to.contains(there)) moved[to.index(there)] = cells[from.index({x, y})];
    }
  }
  cells.swap(moved);
}

}  // namespace outrider
