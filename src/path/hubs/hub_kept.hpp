// What an index of shortest paths, made for one ground, still proves on another.
//
// Let P be a shortest path of the old ground from s to t, and legal on the new one too. Then P is a shortest
// path of the new ground, unless a shorter one, Q, touches a cell that has become free:
//   Q was illegal on the old ground, because nothing there is shorter than P. So Q enters a cell that was
//   blocked, or runs between two that were, or begins or ends where all four cells around were, or passes an
//   old pinch. In the first three cases it touches the closed square of a cell that is free now. So it does
//   at the pinch when one of the four cells around it is freed. Else one or both of its free cells are
//   blocked now; what is free there is at most one quarter of the directions, in which no straight leg goes
//   through and no shortest path bends.
// A path that touches a box of freed cells is no shorter than |s - box| + |box - t|. When that is at least
// |P| for each box, P is a shortest path of the new ground. In the same way, where the old ground has no path
// and no cell has become free, the new one has none.
#pragma once

#include <span>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider::hub_labelling {

/// A rectangle of cells as a closed set of points: from corner to corner.
struct CellBox {
  Cell low, high;
  friend bool operator==(const CellBox&, const CellBox&) = default;
};

/// Those of `changed`, given row by row, that are free in `now`: equal runs in neighbouring rows are one box.
/// O(n log n).
std::vector<CellBox> freed_boxes(const GridMap& now, const std::vector<Cell>& changed);

/// No path from `start` to `goal` that touches one of the boxes is shorter, cells; infinite without boxes.
double least_length_over(std::span<const CellBox> boxes, Cell start, Cell goal);

/// Every leg is free, and no pinch lies between the ends. O(cells on the legs).
bool legal_way(const GridMap& ground, std::span<const Cell> way);

}  // namespace outrider::hub_labelling
