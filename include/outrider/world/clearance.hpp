// Clearance of a grid: how far every cell is from the nearest blocked one. Exact, in whole numbers.
//
// O(cells). Sources: Felzenszwalb and Huttenlocher, Distance transforms of sampled functions (2012);
// the division in whole numbers, Meijster, Roerdink and Hesselink (2000).
#pragma once

#include <cstdint>
#include <limits>

#include "outrider/world/grid.hpp"

namespace outrider {

/// Of every cell in a grid without a blocked one.
inline constexpr std::uint32_t no_obstacle = std::numeric_limits<std::uint32_t>::max();

/// Squared distance from each cell's centre to the centre of the nearest cell other than 0, in cells.
/// The grid is at most 32768 cells a side.
Grid<std::uint32_t> squared_clearance(const Grid<std::uint8_t>& blocked);

}  // namespace outrider
