#include "map/wall_crossings.hpp"

#include <gtest/gtest.h>

#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

/// 4 m by 4 m of free ground with a wall at 2 m that has a door in its middle.
Grid<std::uint8_t> two_rooms() {
  GridFrame frame;
  frame.width = frame.height = 80;
  frame.resolution_m = 0.05;
  Grid<std::uint8_t> grid(frame);
  for (int y = 0; y < frame.height; ++y) {
    if (std::abs(y - 40) > 8) grid[Cell{40, y}] = occupied_cell;
  }
  return grid;
}

TEST(WallCrossings, APathThroughTheDoorCrossesNothingAndOneBesideItDoes) {
  EXPECT_TRUE(wall_crossings({{{1.5, 2.0}, 0}, {{2.4, 2.0}, 0}, {{3.2, 3.5}, 0}}, two_rooms()).empty());
  EXPECT_EQ(
      wall_crossings({{{1.5, 2.0}, 0}, {{1.6, 1.0}, 0}, {{2.4, 1.0}, 0}, {{2.4, 2.0}, 0}, {{1.5, 3.0}, 0}},
                     two_rooms()),
      (std::vector<std::size_t>{2}));
  EXPECT_EQ(wall_crossings({{{1.6, 3.0}, 0}, {{2.4, 3.0}, 0}, {{1.6, 3.0}, 0}}, two_rooms()),
            (std::vector<std::size_t>{1, 2}));
}

TEST(WallCrossings, LongWaysAndPlacesOffTheMapSayNothing) {
  EXPECT_TRUE(wall_crossings({{{1.0, 1.0}, 0}, {{3.0, 1.0}, 0}}, two_rooms()).empty())
      << "2 m may lead around";
  EXPECT_TRUE(wall_crossings({{{-5.0, 9.0}, 0}, {{-5.5, 9.0}, 0}, {{-5.5, 9.0}, 0}}, two_rooms()).empty());
  EXPECT_TRUE(wall_crossings({}, two_rooms()).empty());
}

}  // namespace
}  // namespace outrider
