// The cells of a grid that a ray meets one after another, exactly.
//
// Points are whole numbers of 1/1024 of a cell, and so is all that follows. Where the ray passes a corner
// exactly, the next cell is the one across it; so the cells are those whose interior the ray meets.
// O(1) a cell.
// Source: Amanatides and Woo, A fast voxel traversal algorithm for ray tracing, Eurographics 1987, 3-10.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "outrider/world/grid.hpp"

namespace outrider {

/// A point in units of 1/1024 of a cell. Rays start and segments end off the lines between cells.
struct LatticePoint {
  static constexpr std::int64_t side = 1024;
  std::int64_t x = 0;
  std::int64_t y = 0;

  [[nodiscard]] Cell cell() const { return {static_cast<int>(x >> 10), static_cast<int>(y >> 10)}; }
};

inline constexpr double most_lattice_cells = 1e7;

/// Of a point given in cells, within most_lattice_cells; put to the middle of a sub-cell, 512 to the side of
/// a cell, so that it is on no line.
inline LatticePoint lattice_point(Vec2 cells) {
  return {2 * static_cast<std::int64_t>(std::floor(512.0 * cells.x)) + 1,
          2 * static_cast<std::int64_t>(std::floor(512.0 * cells.y)) + 1};
}
inline LatticePoint lattice_centre(Cell cell) {
  constexpr std::int64_t side = LatticePoint::side;
  return {side * cell.x + side / 2, side * cell.y + side / 2};
}

/// visit(cell) for each cell from that of `a` on, through `b` and beyond, until visit says false; for the
/// first only where b is a.
template <class Visit>
void walk_ray(LatticePoint a, LatticePoint b, Visit&& visit) {
  constexpr std::int64_t side = LatticePoint::side;
  const std::int64_t dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y);
  const int step_x = b.x < a.x ? -1 : 1, step_y = b.y < a.y ? -1 : 1;
  const std::int64_t to_x = b.x < a.x ? a.x & (side - 1) : side - (a.x & (side - 1));
  const std::int64_t to_y = b.y < a.y ? a.y & (side - 1) : side - (a.y & (side - 1));
  // Less than 0: the line between columns is met before that between rows.
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

/// visit(cell) for each cell that the segment meets, that of `a` first and that of `b` last.
template <class Visit>
void cross_cells(LatticePoint a, LatticePoint b, Visit&& visit) {
  const Cell end = b.cell();
  walk_ray(a, b, [&](Cell cell) {
    visit(cell);
    return !(cell == end);
  });
}

}  // namespace outrider
