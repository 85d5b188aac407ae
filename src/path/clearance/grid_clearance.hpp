// Clearance on a grid, to the closed squares of its blocked cells: exact, at any point.
//
// The nearest point of a square to a vertex is a corner or lies level with the vertex, so on the lattice of
// half cells distances to squares are distances to lattice points, squared whole numbers. Lengths are in
// cells, points too, from the lowest corner of the grid.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

struct GridClearance {
  static constexpr int most_side = 16'383;  ///< cells, so that squares of half cells fit

  const GridMap* ground = nullptr;
  std::size_t stride = 0;              ///< of a row of the lattice
  std::vector<std::uint32_t> squared;  ///< half cells, by place()
  std::uint32_t widest_squared = 0;    ///< the largest of them

  /// The ground outlives the clearance. O(cells).
  static GridClearance of(const GridMap& ground);

  /// Where the centre of a cell stands on the lattice.
  [[nodiscard]] std::size_t place(Cell v) const {
    return (2 * static_cast<std::size_t>(v.y) + 1) * stride + 2 * static_cast<std::size_t>(v.x) + 1;
  }
  /// The step on the lattice to the middle of a move.
  [[nodiscard]] std::ptrdiff_t half(Cell move) const {
    return move.y * static_cast<std::ptrdiff_t>(stride) + move.x;
  }
  /// At a place of the lattice, cells.
  [[nodiscard]] double at(std::size_t place) const { return 0.5 * std::sqrt(squared[place]); }
  /// From a point in the grid to the nearest blocked cell. O(clearance).
  [[nodiscard]] double at(Vec2 p) const;
};

/// Exposure of the straight way from a to b, a move or no longer than one, by Simpson's rule on its halves;
/// on the whole where it is 16 cells from everything, which is as good there.
double part_exposure(const GridClearance& clearance, Vec2 a, Vec2 b, double at_a, double at_middle,
                     double at_b);

/// Exposure of the leg between the centres of two cells, in max(|dx|, |dy|) equal parts.
double leg_exposure(const GridClearance& clearance, Cell from, Cell to);

/// Whether the whole leg stays farther than that from blocked cells, cells. Refuses what is within 0.001.
bool leg_is_wider(const GridClearance& clearance, Cell from, Cell to, double least);

}  // namespace outrider
