#include "outrider/navigate/live_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr std::size_t beams = 360;

/// A scan of 360 beams that all end at one range, or in nothing.
LaserScan all_around(double range_m, double time_s = 0.0) {
  LaserScan scan{time_s, 0.0, 2.0 * pi / beams, 0.1, 10.0, {}};
  scan.ranges_m.assign(beams, static_cast<float>(range_m));
  return scan;
}

bool stands_at(const LiveMap& map, Vec2 place) { return map.marked(map.frame().cell_at(place)); }

TEST(LiveMap, MarksWhereBeamsEnd) {
  LiveMap map({}, {});
  map.note(all_around(2.0), {{1.0, 0.0}, 0.3});
  EXPECT_GT(map.marks().size(), 200U);
  for (const Mark& mark : map.marks()) EXPECT_NEAR(distance(mark.place, Vec2{1.0, 0.0}), 2.0, 0.01);
  EXPECT_TRUE(stands_at(map, {2.99, 0.02}) || stands_at(map, {3.01, 0.02}));
  EXPECT_FALSE(stands_at(map, {1.0, 0.0}));
}

TEST(LiveMap, ForgetsWhatBeamsPass) {
  LiveMap map({}, {});
  for (int i = 0; i < 10; ++i) map.note(all_around(2.0), {});
  ASSERT_TRUE(stands_at(map, {2.0, 0.0}));
  for (int i = 0; i < 10; ++i) map.note(all_around(4.0), {});
  EXPECT_FALSE(stands_at(map, {2.0, 0.0}));
  EXPECT_TRUE(stands_at(map, {4.0, 0.0}));
}

/// Notes a scan with one reading at 1 m, before walls at 4 m.
void note_post(LiveMap& map, double time_s, std::size_t beam = 90, float range_m = 1.0F) {
  LaserScan scan = all_around(4.0, time_s);
  scan.ranges_m[beam] = range_m;
  map.note(scan, {});
}

/// A reading that is wrong is alone; a thin post is hit by one beam, but by one of each scan.
TEST(LiveMap, AReadingStandsWhereASecondOneSaysSo) {
  LiveMap map({}, {});
  map.note(all_around(4.0, 0.0), {});
  const std::uint64_t changes = map.changes();
  const std::size_t walls = map.places().size();
  note_post(map, 0.1);
  ASSERT_TRUE(stands_at(map, {0.0, 1.0}));
  EXPECT_EQ(map.places().size(), walls);
  EXPECT_EQ(map.close_places().size(), walls);
  note_post(map, 0.2, 90, 1.04F);  // maybe in the next cell
  EXPECT_GT(map.places().size(), walls);
  EXPECT_GT(map.changes(), changes);
  EXPECT_TRUE(std::ranges::none_of(map.marks(), &Mark::lone));
}

TEST(LiveMap, ALoneReadingIsForgottenWhereBeamsPassItOrNoneComesSoon) {
  LiveMap map({}, {});
  const std::size_t walls = (map.note(all_around(4.0, 0.0), {}), map.marks().size());
  note_post(map, 0.1);
  note_post(map, 0.2, 200);
  EXPECT_FALSE(stands_at(map, {0.0, 1.0}));
  map.forget(0.6);
  EXPECT_EQ(map.marks().size(), walls + 1);
  map.forget(0.8);
  EXPECT_EQ(map.marks().size(), walls);
}

/// A wrong reading right before a wall does not make the wall thicker.
TEST(LiveMap, ALoneReadingBesideAWallIsNoWall) {
  LiveMap map({}, {});
  for (int i = 0; i < 5; ++i) map.note(all_around(4.0, 0.1 * i), {});
  const std::size_t walls = map.places().size();
  note_post(map, 0.6, 90, 3.82F);
  EXPECT_EQ(map.places().size(), walls);
}

TEST(LiveMap, TwoBeamsThatEndBesideEachOtherSeeAThing) {
  LiveMap map({}, {});
  LaserScan scan = all_around(4.0);
  scan.ranges_m[0] = 1.0F;
  scan.ranges_m[beams - 1] = 1.1F;
  map.note(scan, {});
  EXPECT_TRUE(std::ranges::none_of(map.marks(), &Mark::lone));
}

TEST(LiveMap, ReadingsThatSayNothingChangeNothing) {
  LiveMap map({}, {});
  map.note(all_around(2.0), {});
  const std::size_t before = map.marks().size();
  for (const double range_m : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    for (int i = 0; i < 20; ++i) map.note(all_around(range_m), {});
  }
  EXPECT_EQ(map.marks().size(), before);
  LaserScan none = all_around(2.0);
  none.ranges_m.clear();
  map.note(none, {});
  map.note(all_around(3.0), {{std::nan(""), 0.0}, 0.0});
  EXPECT_EQ(map.marks().size(), before);
}

TEST(LiveMap, KeepsWhatIsOutOfViewUntilItIsOld) {
  LiveMapOptions options;
  LiveMap map(options, {});
  map.note(all_around(2.0, 5.0), {});
  map.forget(5.0 + 0.9 * options.forget_s);
  EXPECT_TRUE(stands_at(map, {2.0, 0.0}));
  map.forget(5.0 + 1.1 * options.forget_s);
  EXPECT_TRUE(map.marks().empty());
}

TEST(LiveMap, KeepsWhatWasTouchedAlthoughBeamsPass) {
  LiveMap map({}, {});
  map.note_touch({1.0, 0.0}, 0.0);
  for (int i = 0; i < 20; ++i) map.note(all_around(4.0), {});
  map.keep_open(Footprint::disk(0.2), {{1.0, 0.0}, 0.0});
  EXPECT_TRUE(stands_at(map, {1.0, 0.0}));
}

TEST(LiveMap, ForgetsWhatBeamsPassBesideWhatWasTouched) {
  LiveMap map({}, {});
  map.note_touch({0.0, 1.0}, 0.0);
  for (int i = 0; i < 10; ++i) map.note(all_around(2.0), {});
  ASSERT_TRUE(stands_at(map, {2.0, 0.0}));
  for (int i = 0; i < 10; ++i) map.note(all_around(4.0), {});
  EXPECT_TRUE(stands_at(map, {0.0, 1.0}));
  EXPECT_FALSE(stands_at(map, {2.0, 0.0}));
}

TEST(LiveMap, IsOpenWhereTheRobotIs) {
  LiveMap map({}, {});
  map.note(all_around(0.2), {});
  map.keep_open(Footprint::disk(0.3), {});
  EXPECT_TRUE(map.marks().empty());
}

TEST(LiveMap, MovesWithTheRobotAndKeepsPlaces) {
  LiveMap map({}, {});
  map.note(all_around(2.0), {});
  map.follow({6.0, 0.0});
  EXPECT_TRUE(map.frame().contains(map.frame().cell_at({15.0, 0.0})));
  EXPECT_TRUE(stands_at(map, {2.0, 0.0}));
  map.follow({100.0, 0.0});
  EXPECT_TRUE(map.marks().empty());
}

TEST(LiveMap, MovesItsMarksWithACorrection) {
  LiveMap map({}, {});
  map.note_touch({1.0, 0.0}, 0.0);
  map.correct({{0.5, 0.0}, 0.5 * pi});
  ASSERT_EQ(map.marks().size(), 1U);
  EXPECT_NEAR(distance(map.marks().front().place, Vec2{0.5, 1.0}), 0.0, 1e-12);
  EXPECT_TRUE(stands_at(map, {0.5, 1.0}));
}

LiveMap::Walls wall_at(double x) {
  std::vector<Vec2> places;
  for (double y = -1.0; y <= 1.0; y += 0.05) places.push_back({x, y});
  return std::make_shared<const std::vector<Vec2>>(places);
}

TEST(LiveMap, ForgetsInDoubtOnlyWhereTheLaserLooks) {
  LiveMap map({}, {});
  LaserScan ahead{1.0, -1.0, 0.01, 0.1, 10.0, {}};
  ahead.ranges_m.assign(200, 2.0F);
  map.note(ahead, {});
  ahead.time_s = 3.0;
  ahead.ranges_m.assign(200, 2.05F);
  map.note(ahead, {{0.0, 0.0}, 1.5});  // looks to the left, at half of it, and sees what is hardly behind it
  ASSERT_TRUE(stands_at(map, 2.0 * direction(0.9)));
  ASSERT_TRUE(stands_at(map, 2.0 * direction(-0.9)));
  map.forget_but(3.5, 1.0);
  EXPECT_FALSE(stands_at(map, 2.0 * direction(0.9)));
  EXPECT_TRUE(stands_at(map, 2.0 * direction(-0.9)));
}

TEST(LiveMap, KeepsTheWallsOfAMap) {
  LiveMap map({}, {});
  map.know(wall_at(3.0));
  ASSERT_TRUE(stands_at(map, {3.0, 0.0}));
  map.forget(1e5);
  map.forget_but(1e5, 0.1);
  EXPECT_TRUE(stands_at(map, {3.0, 0.0}));
  map.know(nullptr);
  EXPECT_FALSE(stands_at(map, {3.0, 0.0}));
}

TEST(LiveMap, MovesAWallToWhereItIsSeen) {
  LiveMap map({}, {});
  map.know(wall_at(2.06));
  map.note(all_around(2.0), {});
  EXPECT_TRUE(stands_at(map, {2.0, 0.0}));
  EXPECT_FALSE(stands_at(map, {2.06, 0.0}));
  map.forget(1e5);  // it is still a wall
  EXPECT_TRUE(stands_at(map, {2.0, 0.0}));
  EXPECT_FALSE(stands_at(map, {-2.0, 0.0}));
}

TEST(LiveMap, WallsThatBeamsPassAreGoneUntilTheWindowHasLeft) {
  LiveMap map({}, {});
  map.know(wall_at(3.0));
  for (int i = 0; i < 10; ++i) map.note(all_around(6.0), {});
  EXPECT_FALSE(stands_at(map, {3.0, 0.0}));
  map.follow({4.0, 0.0});
  EXPECT_FALSE(stands_at(map, {3.0, 0.0}));
  map.follow({40.0, 0.0});
  map.follow({0.0, 0.0});
  EXPECT_TRUE(stands_at(map, {3.0, 0.0}));
}

TEST(LiveMap, RemembersForAWhileWhatItHasLeftBehind) {
  LiveMapOptions options;
  LiveMap map(options, {});
  map.note(all_around(2.0, 0.0), {});
  map.follow({40.0, 0.0});
  EXPECT_TRUE(map.behind().empty());  // seen once
  map.follow({});
  for (int i = 0; i < 10; ++i) map.note(all_around(2.0, 1.0), {});
  map.follow({40.0, 0.0});
  EXPECT_GT(map.behind().size(), 100U);
  map.forget(options.remember_s);
  EXPECT_GT(map.behind().size(), 100U);
  map.forget(options.remember_s + 1.5);
  EXPECT_TRUE(map.behind().empty());
}

}  // namespace
}  // namespace outrider
