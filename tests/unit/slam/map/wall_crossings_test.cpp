#include "map/wall_crossings.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
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
  EXPECT_TRUE(wall_crossings({{{1.5, 2.0}, 0}, {{2.4, 2.0}, 0}, {{3.2, 3.5}, 0}}, two_rooms(), {}).empty());
  EXPECT_EQ(
      wall_crossings({{{1.5, 2.0}, 0}, {{1.6, 1.0}, 0}, {{2.4, 1.0}, 0}, {{2.4, 2.0}, 0}, {{1.5, 3.0}, 0}},
                     two_rooms(), {}),
      (std::vector<std::size_t>{2}));
  EXPECT_EQ(wall_crossings({{{1.6, 3.0}, 0}, {{2.4, 3.0}, 0}, {{1.6, 3.0}, 0}}, two_rooms(), {}),
            (std::vector<std::size_t>{1, 2}));
}

TEST(WallCrossings, LongWaysAndPlacesOffTheMapSayNothing) {
  EXPECT_TRUE(wall_crossings({{{1.0, 1.0}, 0}, {{3.0, 1.0}, 0}}, two_rooms(), {}).empty())
      << "2 m may lead around";
  EXPECT_TRUE(
      wall_crossings({{{-5.0, 9.0}, 0}, {{-5.5, 9.0}, 0}, {{-5.5, 9.0}, 0}}, two_rooms(), {}).empty());
  EXPECT_TRUE(wall_crossings({}, two_rooms(), {}).empty());
}

/// The wall is seen from (1, 2) first, then it is a door that stands open.
TEST(WallCrossings, ADoorThatStandsOpenAgainIsNoWall) {
  const std::vector<Pose2> path{{{1.5, 1.0}, 0}, {{2.4, 1.0}, 0}};
  LaserScan closed{0.0, -pi, pi / 180.0, 0.1, 10.0, {}};
  closed.ranges_m.assign(360, 1.4F);
  LaserScan open = closed;
  open.ranges_m.assign(360, 5.0F);
  const Pose2 laser{{1.0, 2.0}, 0.0};
  const PlacedScan wall{&closed, laser, 0.0, 0}, none{&open, laser, 0.0, 0};
  using Scans = std::vector<PlacedScan>;
  const std::vector<std::size_t> crossed{1};
  EXPECT_TRUE(wall_crossings(path, two_rooms(), Scans{wall, none, none}).empty());
  EXPECT_EQ(wall_crossings(path, two_rooms(), Scans{wall, none}), crossed) << "one scan is not enough";
  EXPECT_EQ(wall_crossings(path, two_rooms(), Scans{none, none, wall}), crossed) << "it is closed";
  const PlacedScan far{&open, {{1.0, 30.0}, 0.0}, 0.0, 0};
  EXPECT_TRUE(wall_crossings(path, two_rooms(), Scans{none, none, far}).empty());
}

}  // namespace
}  // namespace outrider
