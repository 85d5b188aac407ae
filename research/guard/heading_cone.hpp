// HeadingCone: one of 16 ranges of headings, and how a straight drive with such a heading crosses a grid.
//
// A cone lies between two steps p and q of the grid that are neighbours in the sequence (1, 0), (2, 1), (1,
// 1), (1, 2), (0, 1), (-1, 2), ... round the circle. Parallelograms with the sides p and q tile the plane,
// one from each vertex of the grid, the centre of a cell. A straight drive with a heading of the cone leaves
// a tile only across its two far sides, to the tiles p and q ahead. Its length is measured by the linear
// function of value `weight` at p and q: never more than heading_scale() times the length, and at least 0.97
// of that.
//
// Coordinates are in cells, from the vertex of the tile.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/geometry/vec.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// The common points of a tile and a cell.
struct TileOverlap {
  Cell cell;               // relative to that of the vertex
  std::int16_t least = 0;  // of the measure from the vertex, over what they share; rounded down
  std::int16_t most = 0;   // rounded up
};

/// One of the sides across which a straight drive leaves a tile.
struct TileExit {
  Cell step;                // to the next tile
  std::int16_t weight = 0;  // the measure of that step
  std::vector<Cell> cells;  // that the side touches
};

struct HeadingCone {
  TileExit p;
  TileExit q;
  double middle_rad = 0.0;
  double half_width_rad = 0.0;
  std::vector<TileOverlap> overlaps;

  /// The least angle from a heading of the cone to `heading_rad`.
  [[nodiscard]] double angle_to(double heading_rad) const;
  /// The least angle between headings of two cones; 0 for neighbours.
  [[nodiscard]] double angle_to(const HeadingCone& other) const;
};

/// The cones, in the order of their headings, from 0 on.
std::vector<HeadingCone> heading_cones();

/// The measure of a drive of length 1 is at most that.
double heading_scale();

}  // namespace outrider
