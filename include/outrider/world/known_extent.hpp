// How far what is known of a map reaches.
#pragma once

#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

/// The cells from low to high, both among them; none of them where high is below low.
struct CellExtent {
  Cell low{0, 0};
  Cell high{-1, -1};

  [[nodiscard]] int width() const { return high.x - low.x + 1; }
  [[nodiscard]] int height() const { return high.y - low.y + 1; }
};

/// The smallest that has all known cells of a grid of Occupancy. O(cells).
CellExtent known_extent(const Grid<std::uint8_t>& occupancy);

}  // namespace outrider
