#include "outrider/world/known_extent.hpp"

#include <limits>

namespace outrider {

CellExtent known_extent(const Grid<std::uint8_t>& occupancy) {
  constexpr int most = std::numeric_limits<int>::max();
  CellExtent known{{most, most}, {-1, -1}};
  std::size_t at = 0;
  for (int y = 0; y < occupancy.frame.height; ++y) {
    for (int x = 0; x < occupancy.frame.width; ++x, ++at) {
      if (occupancy.cells[at] == unknown_cell) continue;
      known.low = {std::min(known.low.x, x), std::min(known.low.y, y)};
      known.high = {std::max(known.high.x, x), std::max(known.high.y, y)};
    }
  }
  return known.high.x < 0 ? CellExtent{} : known;
}

}  // namespace outrider
