// Times on a known map: through its doors, around what was seen, and nowhere that is not known to be free.
#include "outrider/navigate/map_field.hpp"

#include <gtest/gtest.h>

#include "support/building.hpp"

namespace outrider {
namespace {

const std::vector<std::string> two_doors = {
    "#####################", "#         #         #", "#                   #", "#         #         #",
    "#         #         #", "#         #         #", "#         #         #", "#                   #",
    "#         #         #", "#####################",
};

const Footprint narrow = Footprint::disk(0.2);

RobotModel one_metre_a_second() {
  RobotModel robot;
  robot.speed_mps = 1.0;
  return robot;
}

/// A map of which the window shows hardly anything.
LiveMap window_at(Vec2 place) {
  LiveMapOptions options;
  options.reach_m = 1.0;
  return LiveMap(options, place);
}

/// Returns the time from a place, around what is marked at other places.
std::optional<double> time_of(const std::vector<std::string>& rows, Vec2 from, Vec2 goal,
                              const std::vector<Vec2>& seen = {}, double yaw_rad = 0.0) {
  KnownMap map = test::building(rows, 1.0, 10).map;
  map.yaw_rad = yaw_rad;
  MapField field(map);
  LiveMap live = window_at(from);
  for (const Vec2 place : seen) {
    for (double y = -0.9; y <= 0.9; y += 0.04) live.note_touch(place + Vec2{0.0, y}, 0.0);
  }
  field.compute(live, narrow, one_metre_a_second(), {goal}, true);
  return field.time_s(from);
}

TEST(MapField, LeadsThroughTheNearerDoor) {
  const auto near_s = time_of(two_doors, {9.0, 7.5}, {12.0, 7.5});
  ASSERT_TRUE(near_s);
  EXPECT_GT(*near_s, 3.0);
  EXPECT_LT(*near_s, 6.0);
  const auto far_s = time_of(two_doors, {9.0, 5.0}, {12.0, 5.0});
  ASSERT_TRUE(far_s);
  EXPECT_GT(*far_s, 6.0);
}

TEST(MapField, LeadsAroundWhatIsSeen) {
  const auto open_s = time_of(two_doors, {9.5, 7.5}, {12.0, 7.5});
  const auto shut_s = time_of(two_doors, {9.5, 7.5}, {12.0, 7.5}, {{10.3, 7.5}});
  ASSERT_TRUE(open_s && shut_s);
  EXPECT_GT(*shut_s, *open_s + 6.0);
}

TEST(MapField, EntersNothingThatIsNotKnownToBeFree) {
  std::vector<std::string> rows = two_doors;
  for (const std::size_t row : {std::size_t{2}, std::size_t{7}}) rows[row][10] = '?';
  EXPECT_FALSE(time_of(rows, {9.0, 7.5}, {12.0, 7.5}));
}

TEST(MapField, AMapMayBeTurned) {
  const double yaw_rad = 0.7;
  const auto turned = [&](Vec2 place) { return rotated(yaw_rad, place); };
  const auto straight_s = time_of(two_doors, {9.0, 5.0}, {12.0, 5.0});
  const auto turned_s = time_of(two_doors, turned({9.0, 5.0}), turned({12.0, 5.0}), {}, yaw_rad);
  ASSERT_TRUE(straight_s && turned_s);
  EXPECT_NEAR(*turned_s, *straight_s, 0.15 * *straight_s);
}

TEST(MapField, WallsAreWhereFreeGroundEnds) {
  const MapField field(test::building({"####", "#  #", "####"}, 1.0, 10).map);
  ASSERT_FALSE(field.walls()->empty());
  for (const Vec2 wall : *field.walls()) {
    const Box2 free{{1.0, 1.0}, {3.0, 2.0}};
    EXPECT_FALSE(free.contains(wall));
    EXPECT_TRUE(free.grown(0.1).contains(wall));
  }
}

}  // namespace
}  // namespace outrider
