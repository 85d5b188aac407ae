#include "outrider/job/map_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/job/log_map.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/world/occupancy.hpp"
#include "support/growing_map.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

Grid<std::uint8_t> unknown_map() {
  GridFrame frame;
  frame.resolution_m = 0.05;
  frame.origin = {-1.0, 2.0};
  frame.width = 10;
  frame.height = 8;
  return Grid<std::uint8_t>(frame, unknown_cell);
}

const auto& wholes_of(const Log& log) { return log.messages<nav_msgs::OccupancyGrid>(topic::map); }
const auto& updates_of(const Log& log) {
  return log.messages<map_msgs::OccupancyGridUpdate>(topic::map_updates);
}

TEST(MapLog, WhatIsLoggedIsTheMap) {
  for (int i = 0; i < testing::cases(20); ++i) {
    testing::GrowingMap growing(static_cast<std::uint64_t>(i));
    Log log;
    MapLog logged;
    LogMap read;
    double time_s = 0.0;
    for (int k = 1; k <= 200; ++k) {
      const MapUpdate update = growing.change();
      logged.note(log, growing.map, update.redrawn, update.cells, time_s);
      if (k % 20 == 0) {
        logged.finish(log, growing.map, time_s);
        read.read(log);
        ASSERT_EQ(read.grid().frame, growing.map.frame) << k;
        ASSERT_EQ(read.grid().cells, growing.map.cells) << k;
      }
      time_s += growing.rng.uniform(0.05, 0.8);
    }
    EXPECT_GT(updates_of(log).size(), 0U);
    EXPECT_GT(wholes_of(log).size(), 1U);
  }
}

TEST(MapLog, IsLoggedAtMostOnceASecond) {
  testing::GrowingMap growing(7);
  Log log;
  MapLog logged;
  for (int k = 0; k < 500; ++k) {
    const MapUpdate update = growing.change();
    logged.note(log, growing.map, update.redrawn, update.cells, 0.1 * k);
  }
  std::vector<std::int64_t> times_ns;
  for (const auto& whole : wholes_of(log)) times_ns.push_back(whole.time_ns);
  for (const auto& update : updates_of(log)) times_ns.push_back(update.time_ns);
  std::ranges::sort(times_ns);
  ASSERT_GT(times_ns.size(), 20U);
  EXPECT_EQ(times_ns.front(), 0);
  for (std::size_t i = 1; i < times_ns.size(); ++i) EXPECT_GE(times_ns[i] - times_ns[i - 1], 999'999'999);
}

TEST(MapLog, AnUpdateIsTheSmallestRectangleOfAllChanges) {
  auto map = unknown_map();
  Log log;
  MapLog logged;
  logged.note(log, map, false, {}, 0.0);
  ASSERT_EQ(wholes_of(log).size(), 1U) << "the first is whole";
  const auto change = [&](Cell cell, std::uint8_t value, double time_s) {
    map[cell] = value;
    const std::size_t changed[] = {map.frame.index(cell)};
    logged.note(log, map, false, changed, time_s);
  };
  change({5, 3}, occupied_cell, 0.5);
  EXPECT_TRUE(updates_of(log).empty());
  change({2, 4}, free_cell, 1.5);
  ASSERT_EQ(updates_of(log).size(), 1U);
  const auto& update = updates_of(log)[0].message;
  EXPECT_EQ(updates_of(log)[0].time_s(), 1.5);
  EXPECT_EQ(update.x, 2);
  EXPECT_EQ(update.y, 3);
  EXPECT_EQ(update.width, 4U);
  EXPECT_EQ(update.height, 2U);
  EXPECT_EQ(update.data, (std::vector<std::int8_t>{-1, -1, -1, 100, 0, -1, -1, -1}));
  logged.finish(log, map, 1.6);
  EXPECT_EQ(updates_of(log).size(), 1U) << "there is nothing new";
  EXPECT_EQ(wholes_of(log).size(), 1U);
}

TEST(MapLog, AMapThatIsDrawnAgainAtTheTimeOfAnUpdateHolds) {
  auto map = unknown_map();
  Log log;
  MapLog logged;
  logged.note(log, map, false, {}, 0.0);
  map[{5, 3}] = occupied_cell;
  const std::size_t changed[] = {map.frame.index({5, 3})};
  logged.note(log, map, false, changed, 2.0);
  ASSERT_EQ(updates_of(log).size(), 1U);
  map[{5, 3}] = free_cell;
  logged.redraw();
  logged.finish(log, map, 2.0);
  LogMap read;
  read.read(log);
  EXPECT_EQ(read.grid().cells, map.cells);
}

}  // namespace
}  // namespace outrider
