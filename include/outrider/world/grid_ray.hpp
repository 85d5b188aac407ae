// Grid rays: visits the cells of a grid along a ray, exactly.
//
// Points are integers in units of 1/1024 of a cell, and all computations use integers. Where the ray passes
// exactly through a corner, the next cell is the one diagonally across, so the cells visited are those whose
// interior the ray meets. O(1) per cell.
// Source: Amanatides and Woo, A fast voxel traversal algorithm for ray tracing, Eurographics 1987, 3-10.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "outrider/world/grid.hpp"

namespace outrider {

/// A point in units of 1/1024 of a cell. Rays must not start, and segments not end, on a line between cells.
struct LatticePoint {
  static constexpr std::int64_t side = 1024;
  std::int64_t x = 0;
  std::int64_t y = 0;

  [[nodiscard]] Cell cell() const { return {static_cast<int>(x >> 10), static_cast<int>(y >> 10)}; }
};

inline constexpr double most_lattice_cells = 1e7;

/// Converts a point in cells, with coordinates within most_lattice_cells. It is moved to the middle of one of
/// 512 x 512 sub-cells of its cell, so that it never lies on a line between cells.
inline LatticePoint lattice_point(Vec2 cells) {
  return {2 * static_cast<std::int64_t>(std::floor(512.0 * cells.x)) + 1,
          2 * static_cast<std::int64_t>(std::floor(512.0 * cells.y)) + 1};
}
inline LatticePoint lattice_centre(Cell cell) {
  constexpr std::int64_t side = LatticePoint::side;
  return {side * cell.x + side / 2, side * cell.y + side / 2};
}

/// Calls visit(cell) for each cell on the ray from `a` through `b` and beyond, starting with the cell of `a`,
/// until visit returns false. If b equals a, visits only the first cell.
template <class Visit>
void walk_ray(LatticePoint a, LatticePoint b, Visit&& visit) {
  constexpr std::int64_t side = LatticePoint::side;
  const std::int64_t dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y);
  const int step_x = b.x < a.x ? -1 : 1, step_y = b.y < a.y ? -1 : 1;
  const std::int64_t to_x = b.x < a.x ? a.x & (side - 1) : side - (a.x & (side - 1));
  const std::int64_t to_y = b.y < a.y ? a.y & (side - 1) : side - (a.y & (side - 1));
  // Below 0: the ray next crosses a line between columns. Above 0: it next crosses a line between rows.
  std::int64_t order = to_x * dy - to_y * dx;
  for (Cell cell = a.cell(); visit(cell) && dx + dy > 0;) {
    const bool column = order <= 0, row = order >= 0;
    if (column) {
      cell.x += step_x;
      order += side * dy;
    }
    if (row) {
      cell.y += step_y;
      order -= side * dx;
    }
  }
}

/// Calls visit(cell) for each cell that the segment meets, from the cell of `a` to the cell of `b`.
template <class Visit>
void cross_cells(LatticePoint a, LatticePoint b, Visit&& visit) {
  const Cell end = b.cell();
  walk_ray(a, b, [&](Cell cell) {
    visit(cell);
    return !(cell == end);
  });
}

}  // namespace outrider
