#include "outrider/motion/robot_model.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

TEST(DriveCost, TurnsInPlaceThenDrives) {
  const RobotModel robot;
  const DriveCost cost = drive_cost(robot, pi / 2, {{0, 0}, {3, 0}, {3, 4}});
  EXPECT_DOUBLE_EQ(cost.driven_m, 7.0);
  EXPECT_DOUBLE_EQ(cost.turned_rad, pi);
  EXPECT_DOUBLE_EQ(cost.heading_rad, pi / 2);
  const double straights = (3.0 / 0.8 + 1.0) + (4.0 / 0.8 + 1.0);
  const double turns = 2.0 * (pi / 2 / 0.8 + 0.8 / 6.0);
  EXPECT_NEAR(cost.time_s, straights + turns, 1e-12);
}

TEST(DriveCost, TurnsTheShortWay) {
  const DriveCost cost = drive_cost({}, radians(170), {{0, 0}, direction(radians(-170))});
  EXPECT_NEAR(cost.turned_rad, radians(20), 1e-12);
}

TEST(DriveCost, NothingToDriveCostsNothing) {
  for (const auto& waypoints : {std::vector<Vec2>{}, {{1, 1}}, {{1, 1}, {1, 1}, {1, 1}}}) {
    const DriveCost cost = drive_cost({}, 0.3, waypoints);
    EXPECT_EQ(cost.time_s, 0.0);
    EXPECT_EQ(cost.driven_m, 0.0);
    EXPECT_EQ(cost.turned_rad, 0.0);
    EXPECT_EQ(cost.heading_rad, 0.3);
  }
}

TEST(DriveCost, IsTheSumOfItsLegs) {
  Rng rng(1);
  const RobotModel robot;
  for (int round = 0; round < 100; ++round) {
    std::vector<Vec2> waypoints(2 + rng.below(8));
    for (Vec2& p : waypoints) p = {rng.normal(), rng.normal()};
    DriveCost sum;
    sum.heading_rad = rng.uniform(-pi, pi);
    const DriveCost whole = drive_cost(robot, sum.heading_rad, waypoints);
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
      const DriveCost leg = drive_cost(robot, sum.heading_rad, {waypoints[i - 1], waypoints[i]});
      sum = {sum.time_s + leg.time_s, sum.driven_m + leg.driven_m, sum.turned_rad + leg.turned_rad,
             leg.heading_rad};
    }
    EXPECT_DOUBLE_EQ(whole.time_s, sum.time_s);
    EXPECT_DOUBLE_EQ(whole.driven_m, sum.driven_m);
    EXPECT_DOUBLE_EQ(whole.turned_rad, sum.turned_rad);
    EXPECT_EQ(whole.heading_rad, sum.heading_rad);
  }
}

TEST(RobotModel, DefaultsLieInTheirRanges) {
  RobotModel robot;
  for (const Option& option : describe(robot)) {
    EXPECT_TRUE(assign(option, value_text(option))) << option.name;
    EXPECT_LT(option.low, option.high) << option.name;
    EXPECT_FALSE(option.sentence.empty()) << option.name;
  }
  EXPECT_EQ(robot.radius_m, RobotModel{}.radius_m);
}

}  // namespace
}  // namespace outrider
