// The map against exact geometry: which cells a beam crosses, and what a scan does to each cell.
#include "outrider/slam/map/occupancy_map.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "laser_room.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using Key = std::pair<std::int64_t, std::int64_t>;

/// 1/512 of a cell, the middle of it, in units of 1/1024 cell: where the map puts the ends of beams.
std::int64_t put(double cells) { return 2 * static_cast<std::int64_t>(std::floor(512.0 * cells)) + 1; }
std::int64_t cell_of(std::int64_t units) { return units >= 0 ? units / 1024 : -((-units + 1023) / 1024); }

/// Returns true if the segment meets the inside of a cell, by integers: the corners lie on both sides of its
/// line, and its box meets the cell's.
bool meets(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, Key cell) {
  const std::int64_t x0 = cell.first * 1024, y0 = cell.second * 1024, x1 = x0 + 1024, y1 = y0 + 1024;
  if (std::max(ax, bx) <= x0 || std::min(ax, bx) >= x1) return false;
  if (std::max(ay, by) <= y0 || std::min(ay, by) >= y1) return false;
  const auto side = [&](std::int64_t x, std::int64_t y) {
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
  };
  const std::int64_t sides[] = {side(x0, y0), side(x1, y0), side(x0, y1), side(x1, y1)};
  if (ax == bx && ay == by) return true;
  return *std::min_element(std::begin(sides), std::end(sides)) < 0 &&
         *std::max_element(std::begin(sides), std::end(sides)) > 0;
}

/// Returns the effect of a scan, cell by cell of the box around each beam: 1 crossed, 2 hit.
std::map<Key, int> touched(const Pose2& laser, const LaserScan& scan, double side_m) {
  std::map<Key, int> result;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double r = static_cast<double>(scan.ranges_m[i]);
    const bool hits = r >= scan.least_m && r <= scan.most_m;
    if (!hits && !(r > scan.most_m)) continue;
    const Vec2 way = std::min(r, scan.most_m) *
                     direction(laser.heading_rad + (scan.first_rad + static_cast<double>(i) * scan.step_rad));
    const double scale = 1.0 / side_m;
    const std::int64_t x = put(scale * laser.position.x), y = put(scale * laser.position.y);
    const std::int64_t u = put(scale * laser.position.x + scale * way.x),
                       v = put(scale * laser.position.y + scale * way.y);
    for (std::int64_t cy = cell_of(std::min(y, v)); cy <= cell_of(std::max(y, v)); ++cy) {
      for (std::int64_t cx = cell_of(std::min(x, u)); cx <= cell_of(std::max(x, u)); ++cx) {
        if (meets(x, y, u, v, {cx, cy})) result[{cx, cy}] = std::max(result[{cx, cy}], 1);
      }
    }
    if (hits) result[{cell_of(u), cell_of(v)}] = 2;
  }
  return result;
}

TEST(OccupancyMap, IsWhatEachScanDoesToEachCell) {
  Rng rng(1);
  const auto walls = testing::furnished_room();
  for (int trial = 0; trial < testing::cases(3); ++trial) {
    OccupancyMapOptions options;
    options.resolution_m = 0.1;
    OccupancyMap map(options);
    std::map<Key, double> odds;
    std::vector<std::uint8_t> before;
    for (int k = 0; k < 8; ++k) {
      const Pose2 laser{{rng.uniform(0.2, 0.9), rng.uniform(0.2, 3.8)}, rng.uniform(-4.0, 4.0)};
      testing::Finder finder;
      finder.beams = 90;
      finder.step_rad *= 4.0;
      LaserScan scan = testing::scan_from(walls, laser, finder, rng);
      scan.ranges_m[3] = std::numeric_limits<float>::quiet_NaN();
      scan.ranges_m[4] = 0.01F;
      before = map.occupancy().cells;
      const GridFrame frame = map.frame();
      const MapUpdate update = map.insert(laser, scan);
      for (const auto& [cell, what] : touched(laser, scan, options.resolution_m)) {
        constexpr double unit = 1.0 / 1024.0;
        const double change = what == 2 ? options.hit_odds : -options.miss_odds;
        odds[cell] =
            std::clamp(odds[cell] + unit * std::round(change / unit), -options.most_odds, options.most_odds);
      }
      ASSERT_EQ(update.redrawn, !(frame == map.frame()));
      if (update.redrawn) continue;
      std::vector<std::size_t> changed;
      for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i] != map.occupancy().cells[i]) changed.push_back(i);
      }
      EXPECT_EQ(changed, update.cells);
    }
    const GridFrame& frame = map.frame();
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        const Vec2 low = frame.corner({x, y});
        const Key cell{std::lround(low.x / 0.1), std::lround(low.y / 0.1)};
        const auto known = odds.find(cell);
        const double expected = known == odds.end() ? 0.0 : known->second;
        ASSERT_DOUBLE_EQ(map.log_odds({x, y}), expected) << x << ' ' << y;
        const int occupancy = expected < 0 ? free_cell : expected > 0 ? occupied_cell : unknown_cell;
        ASSERT_EQ((map.occupancy()[{x, y}]), occupancy);
      }
    }
  }
}

TEST(OccupancyMap, GrowsWithoutForgetting) {
  Rng rng(2);
  OccupancyMap map({});
  const auto walls = testing::box_walls({-2, -2}, {2, 2});
  const LaserScan scan = testing::scan_from(walls, {}, {}, rng);
  EXPECT_TRUE(map.insert({}, scan).redrawn);
  const auto value_at = [&](Vec2 p) { return map.log_odds(map.frame().cell_at(p)); };
  const double here = value_at({1.0, 0.3});
  EXPECT_LT(here, 0.0);
  EXPECT_TRUE(map.insert({{-40.0, 25.0}, 0.0}, scan).redrawn);
  EXPECT_EQ(value_at({1.0, 0.3}), here);
  EXPECT_EQ(value_at({-39.0, 25.3}), here);
  EXPECT_EQ(map.log_odds({-1, 0}), 0.0);
}

TEST(OccupancyMap, LeavesOutWhatItCannotUse) {
  OccupancyMap map({});
  LaserScan scan{0.0, 0.0, 0.1, 0.1, 5.0, {1.0F, 2.0F}};
  const double inf = std::numeric_limits<double>::infinity();
  for (const Pose2& pose :
       {Pose2{{inf, 0.0}, 0.0}, Pose2{{0.0, 0.0}, std::nan("")}, Pose2{{1e300, 0.0}, 0.0}}) {
    const MapUpdate update = map.insert(pose, scan);
    EXPECT_FALSE(update.redrawn);
    EXPECT_EQ(map.frame().size(), 0U);
  }
  LaserScan endless = scan;
  endless.most_m = 1e6;
  endless.ranges_m = {9e5F, 9e5F};
  EXPECT_FALSE(map.insert({}, endless).redrawn) << "a map of 1e14 cells";
  for (LaserScan bad :
       {LaserScan{}, LaserScan{0.0, 0.0, inf, 0.1, 5.0, {1.0F}}, LaserScan{0.0, 0.0, 0.1, 5.0, 1.0, {1.0F}},
        LaserScan{std::nan(""), 0.0, 0.1, 0.1, 5.0, {1.0F}}}) {
    EXPECT_FALSE(check(bad));
    EXPECT_FALSE(map.insert({}, bad).redrawn);
  }
  EXPECT_TRUE(map.insert({}, scan).redrawn);
}

TEST(OccupancyMap, RefusesOddsThatLeaveNoCellFreeOrOccupied) {
  EXPECT_TRUE(check(OccupancyMapOptions{}));
  OccupancyMapOptions options;
  options.occupied_above = options.most_odds;
  ASSERT_FALSE(check(options));
  EXPECT_EQ(check(options).error().where, "occupancy.occupied_above");
  options.occupied_above = options.most_odds - 0.01;
  EXPECT_TRUE(check(options));
  options.free_below = -options.most_odds;
  ASSERT_FALSE(check(options));
  EXPECT_EQ(check(options).error().where, "occupancy.free_below");
}

}  // namespace
}  // namespace outrider
