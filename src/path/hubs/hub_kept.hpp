// Proofs that an index of shortest paths, made for one ground, still holds on another ground.
//
// Let P be a shortest path of the old ground from s to t that is also legal on the new ground. Then P is a
// shortest path of the new ground, unless a shorter path Q touches a cell that has become free:
//   Q was illegal on the old ground, because nothing there is shorter than P. So (1) Q enters a cell that was
//   blocked, or (2) runs between two such cells, or (3) begins or ends where all four cells around were
//   blocked, or (4) passes an old pinch. In cases 1 to 3, Q touches the closed square of a cell that is free
//   now. The same holds in case 4 if one of the four cells around the pinch became free. Otherwise one or
//   both of the free cells at the pinch are blocked now. Then at most one quarter of the directions is free
//   there, so no straight leg passes through and no shortest path bends.
// A path that touches a box of freed cells is at least |s - box| + |box - t| long. If that is at least |P|
// for each box, P is a shortest path of the new ground. In the same way, if the old ground has no path and no
// cell has become free, the new ground has none.
// Along the eight moves of the model `cells` the same holds with the octile length: a path that was illegal
// enters a cell that was blocked, or passes its corner diagonally. Both touch its closed square.
#pragma once

#include <span>
#include <vector>

#include "grid/octile.hpp"
#include "outrider/path/grid/grid_map.hpp"

namespace outrider::hub_labelling {

/// A rectangle of cells as a closed set of points, from corner to corner.
struct CellBox {
  Cell low, high;
  friend bool operator==(const CellBox&, const CellBox&) = default;
};

/// Returns the cells of `changed` (given row by row) that are free in `now`, as boxes: equal runs in
/// neighbouring rows form one box. O(n log n).
std::vector<CellBox> freed_boxes(const GridMap& now, const std::vector<Cell>& changed);

/// Returns a lower bound of the length of a path from `start` to `goal` that touches one of the boxes, cells;
/// infinite without boxes.
double least_length_over(std::span<const CellBox> boxes, Cell start, Cell goal);

/// Returns true if no path along the eight moves that touches one of the boxes is shorter than `length`.
/// Start and goal are cells; the path runs between their centres.
bool none_shorter_over(std::span<const CellBox> boxes, Cell start, Cell goal, Octile length);

/// Returns true if every leg is free and no pinch lies between the ends. O(cells on the legs).
bool legal_way(const GridMap& ground, std::span<const Cell> way);

}  // namespace outrider::hub_labelling
