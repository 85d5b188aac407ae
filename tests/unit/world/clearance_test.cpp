#include "outrider/world/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

TEST(SquaredClearance, EqualsBruteForce) {
  Rng rng = Rng(1).child("clearance");
  for (int i = 0; i < 400; ++i) {
    GridFrame frame;
    frame.width = 1 + static_cast<int>(rng.below(24));
    frame.height = 1 + static_cast<int>(rng.below(24));
    const double density = i % 4 == 0 ? 0.02 : rng.uniform(0.0, 0.5);
    Grid<std::uint8_t> blocked(frame);
    for (auto& cell : blocked.cells) cell = rng.uniform() < density ? 1 : 0;
    const auto clearance = squared_clearance(blocked);
    for (std::size_t a = 0; a < blocked.cells.size(); ++a) {
      std::uint32_t least = no_obstacle;
      for (std::size_t b = 0; b < blocked.cells.size(); ++b) {
        if (blocked.cells[b] == 0) continue;
        const int dx = frame.cell(a).x - frame.cell(b).x, dy = frame.cell(a).y - frame.cell(b).y;
        least = std::min(least, static_cast<std::uint32_t>(dx * dx + dy * dy));
      }
      ASSERT_EQ(clearance.cells[a], least) << "grid " << i << " cell " << a;
    }
  }
}

TEST(SquaredClearance, HoldsFarCells) {
  GridFrame frame;
  frame.width = 32768;
  frame.height = 2;
  Grid<std::uint8_t> blocked(frame);
  blocked[{0, 0}] = 1;
  EXPECT_EQ((squared_clearance(blocked)[{32767, 1}]), 32767U * 32767U + 1U);
  EXPECT_EQ(squared_clearance(Grid<std::uint8_t>(frame)).cells.front(), no_obstacle);
  EXPECT_TRUE(squared_clearance(Grid<std::uint8_t>{}).cells.empty());
}

}  // namespace
}  // namespace outrider
