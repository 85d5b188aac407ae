#include "outrider/navigate/live_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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
  map.keep_open({1.0, 0.0}, 0.2);
  EXPECT_TRUE(stands_at(map, {1.0, 0.0}));
}

TEST(LiveMap, IsOpenWhereTheRobotIs) {
  LiveMap map({}, {});
  map.note(all_around(0.2), {});
  map.keep_open({}, 0.3);
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

}  // namespace
}  // namespace outrider
