// The outlines of cells as rings of corners.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// Returns rings around the cells that are not 0: a place lies in such a cell if it is inside an odd number
/// of them. Without corners on straight sides; rings may touch at corners. O(cells).
std::vector<std::vector<Vec2>> cell_outlines(const Grid<std::uint8_t>& cells);

}  // namespace outrider
