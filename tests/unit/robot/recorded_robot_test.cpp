#include "outrider/robot/recorded_robot.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(RecordedRobot, EachCommandLeadsToTheNextRecordAndAfterTheLastNothingIsSensed) {
  std::vector<Observation> records(2);
  for (std::size_t i = 0; i < 2; ++i) {
    records[i].time_s = 0.5 * static_cast<double>(i);
    records[i].odometry.position.x = static_cast<double>(i);
    records[i].scan.emplace();
  }
  RecordedRobot robot(records);
  EXPECT_EQ(robot.sense().odometry.position.x, 0.0);
  robot.act(Wait{});
  EXPECT_EQ(robot.sense().odometry.position.x, 1.0);
  EXPECT_TRUE(robot.sense().scan);
  robot.act(Wait{});
  const Observation after = robot.sense();
  EXPECT_EQ(after.time_s, 0.5);
  EXPECT_EQ(after.odometry.position.x, 1.0);
  EXPECT_FALSE(after.scan);
  EXPECT_FALSE(RecordedRobot(std::vector<Observation>{}).sense().scan);
}

TEST(RecordedRobot, ARecordIsTakenOnceAndWhenItIsNeeded) {
  int taken = 0;
  RecordedRobot robot([&]() -> std::optional<Observation> {
    if (taken == 2) return std::nullopt;
    Observation seen;
    seen.time_s = static_cast<double>(++taken);
    seen.scan = LaserScan{};
    return seen;
  });
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(robot.sense().time_s, 1.0);
  EXPECT_EQ(robot.sense().time_s, 1.0);
  robot.act(Wait{});
  EXPECT_EQ(taken, 1);
  EXPECT_EQ(robot.sense().time_s, 2.0);
  robot.act(Wait{});
  EXPECT_EQ(robot.sense().time_s, 2.0);
  EXPECT_FALSE(robot.sense().scan);
}

}  // namespace
}  // namespace outrider
