#include "outrider/world/known_extent.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

TEST(KnownExtent, HasAllThatIsKnownAndTouchesItOnFourSides) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    Grid<std::uint8_t> map(
        GridFrame{{}, 1.0, 1 + static_cast<int>(rng.below(6)), 1 + static_cast<int>(rng.below(6))},
        unknown_cell);
    for (auto& cell : map.cells) cell = rng.below(5) == 0 ? static_cast<std::uint8_t>(rng.below(2)) : cell;
    const CellExtent known = known_extent(map);
    bool left = false, right = false, below = false, above = false;
    for (std::size_t k = 0; k < map.cells.size(); ++k) {
      if (map.cells[k] == unknown_cell) continue;
      const Cell c = map.frame.cell(k);
      EXPECT_TRUE(c.x >= known.low.x && c.x <= known.high.x && c.y >= known.low.y && c.y <= known.high.y);
      left = left || c.x == known.low.x;
      right = right || c.x == known.high.x;
      below = below || c.y == known.low.y;
      above = above || c.y == known.high.y;
    }
    EXPECT_EQ(left && right && below && above, known.width() > 0 && known.height() > 0);
  }
  EXPECT_EQ(known_extent(Grid<std::uint8_t>(GridFrame{{}, 1.0, 3, 2}, unknown_cell)).width(), 0);
  EXPECT_EQ(known_extent({}).height(), 0);
}

}  // namespace
}  // namespace outrider
