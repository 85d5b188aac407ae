// Clearance on a grid: the exact distance from any point to the closed squares of the blocked cells.
//
// The nearest point of a square to a vertex is a corner, or a point at the same x or y as the vertex. So on
// the lattice of half cells, distances to squares are distances to lattice points, whose squares are
// integers. Lengths and points are in cells, from the lowest corner of the grid.
#pragma once

#include <cmath>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

struct GridClearance {
  static constexpr int most_side = 16'383;  ///< cells, so that squares of half cells fit

  const GridMap* ground = nullptr;
  std::size_t stride = 0;              ///< length of a row of the lattice
  std::vector<std::uint32_t> squared;  ///< half cells, by place()
  std::uint32_t widest_squared = 0;    ///< the largest of them

  /// Computes the clearance of a ground, which must outlive the result. O(cells).
  static GridClearance of(const GridMap& ground, const std::stop_token& stop = {});

  /// Returns the lattice index of the centre of a cell.
  [[nodiscard]] std::size_t place(Cell v) const {
    return (2 * static_cast<std::size_t>(v.y) + 1) * stride + 2 * static_cast<std::size_t>(v.x) + 1;
  }
  /// Returns the lattice step to the middle of a move.
  [[nodiscard]] std::ptrdiff_t half(Cell move) const {
    return move.y * static_cast<std::ptrdiff_t>(stride) + move.x;
  }
  /// Returns the clearance at a lattice point, cells.
  [[nodiscard]] double at(std::size_t place) const { return 0.5 * std::sqrt(squared[place]); }
  /// Returns the distance from a point in the grid to the nearest blocked cell, cells. O(clearance).
  [[nodiscard]] double at(Vec2 p) const;
};

/// Returns the exposure of the straight segment from a to b, which is at most as long as a move. Uses
/// Simpson's rule on its halves; on the whole segment if it is at least 16 cells from every obstacle, which
/// is as accurate there.
double part_exposure(const GridClearance& clearance, Vec2 a, Vec2 b, double at_a, double at_middle,
                     double at_b);

/// Returns the exposure of the leg between the centres of two cells, in max(|dx|, |dy|) equal parts.
double leg_exposure(const GridClearance& clearance, Cell from, Cell to);

/// Returns true if the whole leg is farther than `least` from blocked cells, cells. Returns false within
/// 0.001 of it.
bool leg_is_wider(const GridClearance& clearance, Cell from, Cell to, double least);

}  // namespace outrider
