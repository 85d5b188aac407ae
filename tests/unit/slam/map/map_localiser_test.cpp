// Localisation in simulated flats whose walls, and so the true pose, are known.
#include "outrider/slam/map/map_localiser.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "flat.hpp"
#include "outrider/slam/map/occupancy_map.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::Wall;
using testing::Wanderer;
constexpr testing::Finder finder = testing::flat_finder;

struct Found {
  double way_m = 0.0;    ///< until it was located; all of the way if it was not
  double error_m = 0.0;  ///< at the end, if located there
  bool located = false;  ///< at the end
  double wrong_m = 0.0;  ///< way on which it was located more than 0.3 m from the truth
};

/// Drives for so long and compares the pose with the truth.
Found drive(MapLocaliser& localiser, Wanderer& robot, const std::vector<Wall>& walls, double way_m,
            Rng& rng) {
  Found found;
  bool yet = false;
  for (const double end_m = robot.way_m + way_m; robot.way_m < end_m;) {
    const double before_m = robot.way_m;
    const Pose2 motion = robot.step();
    const auto step = localiser.advance(motion, testing::scan_from(walls, robot.pose, finder, rng));
    EXPECT_TRUE(step);
    found.error_m = distance(step->pose.position, robot.pose.position);
    found.located = step->located;
    yet = yet || (step->located && found.error_m < 0.3);
    if (!yet) found.way_m += robot.way_m - before_m;
    if (step->located && found.error_m > 0.3) found.wrong_m += robot.way_m - before_m;
  }
  return found;
}

TEST(MapLocaliser, FindsAKidnappedRobotAgainWithinTenMetres) {
  const int trials = testing::cases(4);
  int at_start = 0, again = 0;
  std::vector<double> ways_m;
  for (int trial = 0; trial < trials; ++trial) {
    Rng rng(static_cast<std::uint64_t>(trial) + 1);
    const std::vector<Wall> walls = testing::flat(rng);
    auto localiser = MapLocaliser::begin(testing::known_map(walls, rng), {});
    ASSERT_TRUE(localiser);
    Wanderer robot(walls, rng);
    const Found first = drive(*localiser, robot, walls, 10.0, rng);
    testing::kidnap(robot, walls, rng);
    const Found second = drive(*localiser, robot, walls, 10.0, rng);
    for (const Found& found : {first, second}) {
      EXPECT_TRUE(!found.located || found.error_m < 0.1) << trial << ": " << found.error_m;
    }
    EXPECT_EQ(first.wrong_m, 0.0) << trial;
    EXPECT_LT(second.wrong_m, 1.5) << trial << ": it may take some scans to notice";
    at_start += first.located ? 1 : 0;
    again += second.located ? 1 : 0;
    ways_m.push_back(second.way_m);
  }
  std::ranges::sort(ways_m);
  EXPECT_GE(20 * at_start, 19 * trials);
  EXPECT_GE(20 * again, 19 * trials);
  RecordProperty("first_found", at_start);
  RecordProperty("found_again", again);
  RecordProperty("median_way_m", std::to_string(ways_m[ways_m.size() / 2]));
}

TEST(MapLocaliser, TakesTheStartThatItIsTold) {
  for (int trial = 0; trial < testing::cases(3); ++trial) {
    Rng rng(static_cast<std::uint64_t>(trial) + 1);
    const std::vector<Wall> walls = testing::flat(rng);
    Wanderer robot(walls, rng);
    const Pose2 told = compose(robot.pose, Pose2{{0.25, -0.2}, 0.1});
    auto localiser = MapLocaliser::begin(testing::known_map(walls, rng), {}, told);
    ASSERT_TRUE(localiser);
    EXPECT_TRUE(localiser->is_located());
    const Found found = drive(*localiser, robot, walls, 3.0, rng);
    EXPECT_TRUE(found.located) << trial;
    EXPECT_LT(found.error_m, 0.1) << trial;
    EXPECT_LT(found.wrong_m, 0.3) << trial;
  }
}

TEST(MapLocaliser, IsLocatedNowhereOnTheMapOfAnotherFlat) {
  Rng rng(3);
  const std::vector<Wall> walls = testing::flat(rng), others = testing::flat(rng);
  auto localiser = MapLocaliser::begin(testing::known_map(others, rng), {});
  ASSERT_TRUE(localiser);
  Wanderer robot(walls, rng);
  EXPECT_FALSE(drive(*localiser, robot, walls, 12.0, rng).located);
}

TEST(MapLocaliser, DoesNotGuessBetweenTwoEqualRooms) {
  Rng rng(4);
  std::vector<Wall> room = testing::furnished_room(), both = room;
  for (const Wall& wall : room) both.push_back({wall.a + Vec2{8.0, 1.0}, wall.b + Vec2{8.0, 1.0}});
  OccupancyMap drawn({});
  for (int i = 0; i < 200; ++i) {
    const Pose2 pose{{rng.uniform(0.2, 5.8), rng.uniform(0.2, 3.8)}, 0.0};
    const LaserScan scan = testing::scan_from(room, pose, finder, rng);
    drawn.insert(pose, scan);
    drawn.insert({pose.position + Vec2{8.0, 1.0}, 0.0}, scan);
  }
  auto twice = MapLocaliser::begin({drawn.occupancy(), 0.0}, {});
  ASSERT_TRUE(twice);
  Wanderer robot(room, rng);
  EXPECT_FALSE(drive(*twice, robot, room, 6.0, rng).located);
}

TEST(MapLocaliser, HeedsTheTurnOfTheMap) {
  Rng rng(5);
  const std::vector<Wall> walls = testing::flat(rng);
  const KnownMap straight = testing::known_map(walls, rng);
  KnownMap turned = straight;
  turned.yaw_rad = 0.4;
  turned.occupancy.frame.origin = straight.occupancy.frame.origin + Vec2{3.0, -2.0};
  auto localiser = MapLocaliser::begin(turned, {});
  ASSERT_TRUE(localiser);
  Wanderer robot(walls, rng);
  for (int i = 0; i < 150; ++i) {
    const Pose2 motion = robot.step();
    ASSERT_TRUE(localiser->advance(motion, testing::scan_from(walls, robot.pose, finder, rng)));
  }
  ASSERT_TRUE(localiser->is_located());
  const Vec2 origin = turned.occupancy.frame.origin;
  const Vec2 there = origin + rotated(0.4, robot.pose.position - straight.occupancy.frame.origin);
  EXPECT_LT(distance(localiser->pose().position, there), 0.1);
  EXPECT_NEAR(wrap_angle(localiser->pose().heading_rad - robot.pose.heading_rad - 0.4), 0.0, 0.03);
}

TEST(MapLocaliser, RefusesInASentence) {
  EXPECT_FALSE(MapLocaliser::begin({}, {}));
  Grid<std::uint8_t> wide(GridFrame{{}, 1.0, 600, 4}, free_cell);
  wide[{0, 0}] = wide[{599, 0}] = occupied_cell;
  EXPECT_FALSE(MapLocaliser::begin({wide, 0.0}, {})) << "as many metres would take gigabytes";
  Rng rng(6);
  const std::vector<Wall> walls = testing::furnished_room();
  OccupancyMap drawn({});
  drawn.insert({{2.0, 2.0}, 0.0}, testing::scan_from(walls, {{2.0, 2.0}, 0.0}, finder, rng));
  LaserSlamOptions options;
  options.reach_m = -1.0;
  EXPECT_FALSE(MapLocaliser::begin({drawn.occupancy(), 0.0}, options));
  auto localiser = MapLocaliser::begin({drawn.occupancy(), 0.0}, {});
  ASSERT_TRUE(localiser);
  EXPECT_FALSE(localiser->advance({{std::nan(""), 0.0}, 0.0}, {}));
  EXPECT_TRUE(localiser->advance({}, {})) << "a scan that cannot be used is ignored";
}

}  // namespace
}  // namespace outrider
