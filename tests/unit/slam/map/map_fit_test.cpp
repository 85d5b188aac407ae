#include "outrider/slam/map/map_fit.hpp"

#include <gtest/gtest.h>

#include "laser_room.hpp"
#include "outrider/slam/map/occupancy_map.hpp"

namespace outrider {
namespace {

/// The map of a furnished room, drawn from known poses.
Grid<std::uint8_t> map_of(const std::vector<testing::Wall>& walls) {
  Rng rng(1);
  OccupancyMap map({});
  for (const Vec2 place : {Vec2{0.5, 0.5}, {2.4, 2.0}, {5.5, 0.6}, {5.5, 3.5}, {0.5, 3.5}, {3.5, 3.4}})
    map.insert({place, 0.0}, testing::scan_from(walls, {place, 0.0}, {.most_m = 8.0}, rng));
  return map.occupancy();
}

TEST(MapFit, CountsWhatABeamMeets) {
  const std::vector<testing::Wall> walls = testing::furnished_room();
  const Grid<std::uint8_t> map = map_of(walls);
  Rng rng(2);
  const Pose2 pose{{2.0, 2.6}, 0.3};
  const auto scan_of = [&](const std::vector<testing::Wall>& seen) {
    return testing::scan_from(seen, pose, {.most_m = 8.0}, rng);
  };

  const MapFit right = map_fit(map, pose, scan_of(walls), 30.0);
  EXPECT_GT(right.beams(), 100U);
  EXPECT_GT(right.share(), 0.97);
  EXPECT_LT(right.contradiction(), 0.02);

  std::vector<testing::Wall> with_person = walls;
  for (const testing::Wall& wall : testing::box_walls({2.4, 2.5}, {2.7, 2.8})) with_person.push_back(wall);
  const MapFit person = map_fit(map, pose, scan_of(with_person), 30.0);
  EXPECT_GT(person.unexpected, 5U);
  EXPECT_LT(person.contradiction(), 0.02) << "something new contradicts nothing";

  const std::vector<testing::Wall> gone = testing::box_walls({0, 0}, {9, 9});
  EXPECT_GT(map_fit(map, pose, scan_of(gone), 30.0).contradiction(), 0.5);

  const MapFit moved = map_fit(map, {{3.5, 1.6}, 1.5}, scan_of(walls), 30.0);
  EXPECT_LT(moved.share(), 0.6) << "at another pose";
  EXPECT_GT(map_fit(map, {{-20.0, 0.0}, 0.0}, scan_of(walls), 30.0).unknown, 100U) << "beyond the map";
}

TEST(MapFit, ABeamWithoutAReadingSaysNothing) {
  const Grid<std::uint8_t> map = map_of(testing::furnished_room());
  LaserScan scan{0.0, 0.0, 0.1, 0.1, 8.0, std::vector<float>(60, std::nanf(""))};
  const MapFit fit = map_fit(map, {{2.0, 2.6}, 0.0}, scan, 30.0);
  EXPECT_EQ(fit.beams() + fit.unknown, 0U);
  EXPECT_EQ(fit.share(), 1.0);
  EXPECT_EQ(fit.contradiction(), 0.0);
}

}  // namespace
}  // namespace outrider
