// The exact test of a leg or an arc against the blocked cells of a grid. All coordinates are in cells.
//
// A part of a curve along which neither x nor y turns back covers, in each row of cells, the columns between
// the two points at which it enters and leaves the row. So the cells that it touches are found row by row:
// O(cells touched), one square root for each row that an arc enters. Cells are closed squares, grown by 1e-9,
// and everything outside the grid is blocked.
#pragma once

#include <span>
#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

/// A part of a leg or an arc along which neither x nor y turns back.
struct MonotonePart {
  Vec2 from;
  Vec2 to;
  Vec2 centre;          ///< of the arc
  double radius = 0.0;  ///< of the arc; 0 for a leg
  double side = 1.0;    ///< 1: the arc lies right of its centre, -1: left of it
};

/// Splits a piece and adds its parts.
void add_monotone_parts(const PathPiece& piece, std::vector<MonotonePart>& parts);

/// Cells are larger by so much to each side.
inline constexpr double cell_touch = 1e-9;

/// Returns true if the part, moved by `by`, stays in the grid and does not touch its border.
bool is_inside(const GridMap& ground, const MonotonePart& part, Vec2 by);

/// Widens the ranges of x in the rows from `first_row` on to what the part, moved by `by`, takes there. All
/// of its rows must be among them.
void widen_rows(const MonotonePart& part, Vec2 by, int first_row, std::span<Interval> rows);

/// Returns true if the part, moved by `by`, touches no blocked cell.
bool clear_of_cells(const GridMap& ground, const MonotonePart& part, Vec2 by = {});

/// Returns true if the piece touches no blocked cell.
bool clear_of_cells(const GridMap& ground, const PathPiece& piece);

/// Adds the cells that the piece touches, some of them twice.
void add_touched_cells(const PathPiece& piece, std::vector<Cell>& cells);

}  // namespace outrider
