#include "outrider/job/log_map.hpp"

#include <gtest/gtest.h>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

nav_msgs::OccupancyGrid map_of(Vec2 origin, int width, int height, std::vector<std::int8_t> data) {
  nav_msgs::OccupancyGrid map;
  map.info.resolution = 0.05F;
  map.info.width = static_cast<std::uint32_t>(width);
  map.info.height = static_cast<std::uint32_t>(height);
  map.info.origin = pose_of(Pose2{origin, 0.0});
  map.data = std::move(data);
  return map;
}

/// Three cells: one is known from the beginning, one from 10 s on, one never; then the map grows by one cell.
Log growing() {
  Log log;
  log.append(topic::map, 0.0, map_of({0.1, 0.2}, 3, 1, {0, -1, -1}));
  log.append(topic::map_updates, 10.0, map_msgs::OccupancyGridUpdate{{}, 1, 0, 1, 1, {100}});
  log.append(topic::map, 20.0, map_of({0.05, 0.2}, 4, 1, {0, 0, 100, -1}));
  return log;
}

TEST(LogMap, AppliesWholeMapsAndUpdatesInTheOrderOfTime) {
  const Log log = growing();
  LogMap map;
  std::vector<double> times_s;
  std::vector<std::size_t> changes;
  map.read(log, [&](const Grid<std::uint8_t>& grid, bool whole, std::span<const std::size_t> cells,
                    double time_s) {
    times_s.push_back(time_s);
    changes.push_back(whole ? grid.cells.size() : cells.size());
    if (!whole) {
      EXPECT_EQ(cells[0], 1U);
      EXPECT_EQ(grid.cells, (std::vector<std::uint8_t>{free_cell, occupied_cell, unknown_cell}));
    }
  });
  EXPECT_EQ(times_s, (std::vector<double>{0.0, 10.0, 20.0}));
  EXPECT_EQ(changes, (std::vector<std::size_t>{3, 1, 4}));
  EXPECT_EQ(map.grid().frame, (GridFrame{{0.05, 0.2}, 0.05, 4, 1}));
  EXPECT_EQ(map.grid().cells, (std::vector<std::uint8_t>{free_cell, free_cell, occupied_cell, unknown_cell}));
  bool again = false;
  map.read(log, [&](const auto&, bool, std::span<const std::size_t>, double) { again = true; });
  EXPECT_FALSE(again) << "each message once";
}

TEST(LogMap, AMapThatDoesNotAddUpIsEmptyAndCellsOutsideAreLeftOut) {
  Log log;
  log.append(topic::map, 0.0, map_of({0.0, 0.0}, 3, 2, {0, 0, 0, 0, 0}));
  LogMap map;
  map.read(log);
  EXPECT_TRUE(map.grid().cells.empty());
  log.append(topic::map, 1.0, map_of({0.0, 0.0}, 2, 1, {0, 0}));
  log.append(topic::map_updates, 2.0, map_msgs::OccupancyGridUpdate{{}, 1, 0, 2, 2, {100, 100, 100, 100}});
  map.read(log);
  EXPECT_EQ(map.grid().cells, (std::vector<std::uint8_t>{free_cell, occupied_cell}));
}

}  // namespace
}  // namespace outrider
