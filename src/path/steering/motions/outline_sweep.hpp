// The exact test of a robot with a convex outline against the blocked cells of a grid, along a leg or an arc.
// All coordinates are in cells; cells are closed squares, grown by 1e-9.
//
// The border of what the robot sweeps consists of its sides at the beginning and at the end, the ways of its
// corners and, on an arc, the ways of the points of its sides that are nearest to the centre. So in each row
// of cells the robot stays between the least and the largest x of these. On a leg it is convex and touches
// every cell between. On an arc it may bend around a cell there, so a blocked one is judged by itself: the
// robot covers it at the begin, or a corner of the robot comes to it, or a corner of the cell comes to the
// robot, in whose frame the cell moves backwards. O(rows * corners + cells), and O(corners) for each cell
// that is judged.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "cell_sweep.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {

/// A piece on which a robot with that heading at the beginning sweeps its outline: convex, counter-clockwise
/// around its origin; a single point, the origin, is a disk.
struct OutlineSweep {
  const std::vector<Vec2>& outline;
  PathPiece piece;
  double heading_rad;
};

/// Calls visit(section) for sections of the sweep that turn by at most 45 degrees, on which the rows leave
/// few cells to judge, while that returns true. Returns false if it once did not.
template <class Visit>
bool for_each_section(const OutlineSweep& sweep, Visit visit) {
  const double turn_rad = sweep.piece.turn_rad;
  const int sections = std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / (0.25 * pi))));
  if (sections == 1) return visit(sweep);
  for (int i = 0; i < sections; ++i) {
    const double from = static_cast<double>(i) / sections;
    const PathPiece piece = section_of(sweep.piece, from, (i + 1.0) / sections);
    if (!visit(OutlineSweep{sweep.outline, piece, sweep.heading_rad + from * turn_rad})) return false;
  }
  return true;
}

/// Adds the parts of the border, as far as it may be left, right, above or below all else.
void add_border_parts(const OutlineSweep& sweep, std::vector<MonotonePart>& parts);

/// Returns true if the robot touches no blocked cell on the piece moved by `by`. `border` holds the parts of
/// add_border_parts().
bool clear_of_cells(const GridMap& ground, const OutlineSweep& sweep, std::span<const MonotonePart> border,
                    Vec2 by);

/// Adds the cells that the robot touches on the piece, some of them twice.
void add_touched_cells(const OutlineSweep& sweep, std::vector<Cell>& cells);

}  // namespace outrider
