#include "outrider/navigate/goal_field.hpp"
#include "outrider/navigate/live_map.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

const Footprint disk = Footprint::disk(0.2);

RobotModel fast() {
  RobotModel robot;
  robot.speed_mps = 1.0;
  return robot;
}

/// A wall across the map at x = 1, open where |y - gap_y| < half.
void wall(LiveMap& map, double gap_y, double half) {
  for (double y = -9.9; y < 9.9; y += 0.04) {
    if (std::abs(y - gap_y) >= half) map.note_touch({1.0, y}, 0.0);
  }
}

TEST(GoalField, IsTheStraightWayOnOpenGround) {
  GoalField field;
  field.compute({LiveMap({}, {}).frame(), {}}, disk, fast(), {{4.0, 0.0}}, Vec2{});
  EXPECT_NEAR(field.time_s({}).value_or(0.0), 4.0, 0.15);
  const auto down = field.downhill({});
  ASSERT_TRUE(down);
  EXPECT_GT(down->x, 0.95);
}

TEST(GoalField, LeadsThroughTheDoor) {
  LiveMap map({}, {});
  wall(map, 3.0, 0.6);
  GoalField field;
  field.compute({map.frame(), map.places()}, disk, fast(), {{2.0, 0.0}}, Vec2{});
  const auto time_s = field.time_s({});
  ASSERT_TRUE(time_s);
  EXPECT_GT(*time_s, distance(Vec2{}, Vec2{1.0, 3.0}) + distance(Vec2{1.0, 3.0}, Vec2{2.0, 0.0}) - 0.5);
  const auto way = field.way({}, 20.0);
  EXPECT_LT(distance(way.back(), Vec2{2.0, 0.0}), 0.15);
  for (const Vec2 point : way) {
    for (const Mark& mark : map.marks()) EXPECT_GT(distance(point, mark.place), disk.inner_m() - 0.05);
  }
}

TEST(GoalField, KnowsNoWayThroughADoorThatIsTooNarrow) {
  LiveMap map({}, {});
  wall(map, 3.0, 0.15);
  GoalField field;
  field.compute({map.frame(), map.places()}, disk, fast(), {{2.0, 0.0}}, Vec2{});
  EXPECT_FALSE(field.time_s({}));
  EXPECT_FALSE(field.downhill({}));
}

TEST(GoalField, GoesToTheEdgeOfTheWindowForAGoalBeyond) {
  LiveMap map({}, {});
  wall(map, -2.0, 0.6);
  GoalField field;
  field.compute({map.frame(), map.places()}, disk, fast(), {{60.0, 0.0}}, Vec2{});
  const auto time_s = field.time_s({});
  ASSERT_TRUE(time_s);
  EXPECT_GT(*time_s, 59.0);
  EXPECT_LT(*time_s, 66.0);
  EXPECT_GT(field.way({}, 40.0).back().x, 9.0);
}

TEST(GoalField, ARobotThatStandsTooNearToSomethingCanLeave) {
  LiveMap map({}, {});
  map.note_touch({0.05, 0.0}, 0.0);
  GoalField field;
  field.compute({map.frame(), map.places()}, disk, fast(), {{4.0, 0.0}}, Vec2{});
  EXPECT_TRUE(field.time_s({}));
}

/// Returns the time for 8 m along a corridor whose walls are so far from its middle.
double time_between_walls(double apart_m, const GoalQuery& query) {
  LiveMap map({}, {});
  for (double x = -6.0; x < 6.0; x += 0.04) {
    map.note_touch({x, apart_m}, 0.0);
    map.note_touch({x, -apart_m}, 0.0);
  }
  GoalField field;
  field.compute({map.frame(), map.places()}, disk, fast(), query, Vec2{-4.0, 0.0});
  return field.time_s({-4.0, 0.0}).value_or(1e9);
}

TEST(GoalField, TheSpeedGrowsWithTheRoomUntilTheRobotIsAsFastAsItCan) {
  GoalQuery query{{4.0, 0.0}};
  query.wide_m = 0.6;
  query.margin_m = 0.1;
  const double open_s = time_between_walls(0.3 + 0.75, query), half_s = time_between_walls(0.3 + 0.3, query),
               least_s = time_between_walls(0.3 + 0.06, query);
  EXPECT_NEAR(open_s, 8.0, 0.3);
  EXPECT_NEAR(8.0 / half_s, 0.625, 0.06) << "half of what is between a quarter and all";
  EXPECT_NEAR(8.0 / least_s, 0.325, 0.06);
  EXPECT_EQ(time_between_walls(0.2, query), 1e9) << "it keeps its margin";
}

}  // namespace
}  // namespace outrider
