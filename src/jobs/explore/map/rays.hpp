// Rays over a grid, as the cells that they meet one after another.
#pragma once

#include <cmath>
#include <vector>

#include "outrider/core/units.hpp"
#include "outrider/world/grid_ray.hpp"

namespace outrider {

/// visit(cell) for each cell that the straight way from the centre of one cell through the centre of another
/// meets, from the one after `from` on, until visit says false.
template <class Visit>
void walk_ray(Cell from, Cell through, Visit visit) {
  walk_ray(lattice_centre(from), lattice_centre(through),
           [&](Cell cell) { return cell == from || visit(cell); });
}

/// Rays of one length in evenly spread directions, as offsets.
struct RayFan {
  int cells = 0;  ///< length
  std::vector<std::vector<Cell>> rays;

  static RayFan of(int cells, int count) {
    RayFan fan{cells, {}};
    for (int i = 0; i < count; ++i) {
      const Vec2 along = 4096.0 * direction(2.0 * pi * (i + 0.5) / count);
      const Cell through{static_cast<int>(std::lround(along.x)), static_cast<int>(std::lround(along.y))};
      std::vector<Cell> ray;
      walk_ray({0, 0}, through, [&](Cell cell) {
        if (cell.x * cell.x + cell.y * cell.y > cells * cells) return false;
        ray.push_back(cell);
        return true;
      });
      fan.rays.push_back(std::move(ray));
    }
    return fan;
  }
};

}  // namespace outrider
