// Known extent: the range of the known cells of a map.
#pragma once

#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

/// The range of cells from low to high, both included. It is empty if high is below low.
struct CellExtent {
  Cell low{0, 0};
  Cell high{-1, -1};

  [[nodiscard]] int width() const { return high.x - low.x + 1; }
  [[nodiscard]] int height() const { return high.y - low.y + 1; }
};

/// Returns the smallest extent that contains all known cells of a grid of Occupancy. O(cells).
CellExtent known_extent(const Grid<std::uint8_t>& occupancy);

}  // namespace outrider
