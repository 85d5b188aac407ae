// Clearance of a grid: the distance from each cell to the nearest blocked one. Exact, in integers.
//
// O(cells). Sources: Felzenszwalb and Huttenlocher, Distance transforms of sampled functions (2012); the
// integer division: Meijster, Roerdink and Hesselink (2000).
#pragma once

#include <cstdint>
#include <limits>
#include <stop_token>

#include "outrider/world/grid.hpp"

namespace outrider {

/// The value of all cells if no cell of the grid is blocked.
inline constexpr std::uint32_t no_obstacle = std::numeric_limits<std::uint32_t>::max();

/// Returns the squared distance, in cells^2, from the centre of each cell to the centre of the nearest cell
/// that is not 0. The grid must have at most 32768 cells on each side. After a stop request the result is
/// meaningless.
Grid<std::uint32_t> squared_clearance(const Grid<std::uint8_t>& blocked, const std::stop_token& stop = {});

}  // namespace outrider
