// The cells of a lattice that a segment crosses, exactly.
//
// Ends are put to the middle of sub-cells, 512 to the side of a cell, so that neither lies on a line of the
// lattice, and all that follows is integers: the cells are exactly those whose interior the segment between
// the ends so put meets, in their order. O(cells crossed).
// Source: Amanatides and Woo, A fast voxel traversal algorithm for ray tracing, Eurographics 1987, 3-10.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "outrider/world/grid.hpp"

namespace outrider {

/// A point in units of 1/1024 of a cell; both are odd.
struct LatticePoint {
  std::int64_t x = 0;
  std::int64_t y = 0;

  [[nodiscard]] Cell cell() const { return {static_cast<int>(x >> 10), static_cast<int>(y >> 10)}; }
};

inline constexpr double most_lattice_cells = 1e7;

/// Of a point given in cells; within most_lattice_cells.
inline LatticePoint lattice_point(Vec2 cells) {
  return {2 * static_cast<std::int64_t>(std::floor(512.0 * cells.x)) + 1,
          2 * static_cast<std::int64_t>(std::floor(512.0 * cells.y)) + 1};
}

/// Calls visit(Cell) for each cell from a's to b's, both among them.
template <class Visit>
void cross_cells(LatticePoint a, LatticePoint b, Visit&& visit) {
  constexpr std::int64_t side = 1024;
  const std::int64_t dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y);
  const int step_x = b.x < a.x ? -1 : 1, step_y = b.y < a.y ? -1 : 1;
  Cell cell = a.cell();
  const Cell end = b.cell();
  const std::int64_t to_x = b.x < a.x ? a.x & (side - 1) : side - (a.x & (side - 1));
  const std::int64_t to_y = b.y < a.y ? a.y & (side - 1) : side - (a.y & (side - 1));
  // Less than 0: the line between columns is met before that between rows.
  std::int64_t order = to_x * dy - to_y * dx;
  visit(cell);
  while (!(cell == end)) {
    const bool column = order <= 0, row = order >= 0;
    if (column) {
      cell.x += step_x;
      order += side * dy;
    }
    if (row) {
      cell.y += step_y;
      order -= side * dx;
    }
    visit(cell);
  }
}

}  // namespace outrider
