// Each node alone.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/coverage_node.hpp"
#include "outrider/nodes/follower_node.hpp"
#include "outrider/nodes/messages/message_faults.hpp"
#include "outrider/nodes/planner_node.hpp"

namespace outrider {
namespace {

template <class Message>
void give(Node& node, const std::string& topic, const Message& message, double time_s) {
  for (std::size_t i = 0; i < node.inputs().size(); ++i) {
    if (node.inputs()[i].name == topic) node.receive(i, encode(MessageEncoding::cdr, message), time_s);
  }
}

/// Returns the newest message that the node sent on a topic.
template <class Message>
std::optional<Message> newest(Node& node, const std::string& topic) {
  std::optional<Message> found;
  for (const NodeOutput& output : node.take_outputs()) {
    if (node.outputs()[output.topic].name != topic) continue;
    found = decode<Message>(MessageEncoding::cdr, output.bytes).value();
  }
  return found;
}

tf2_msgs::TFMessage place(double time_s, const Pose2& pose) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {transform_of(time_s, {}, "map", "odom"),
                           transform_of(time_s, pose, "odom", "base_link")};
  return transforms;
}

/// A room of 4 m x 4 m with a wall across it, which has a door at its upper end if `door`.
nav_msgs::OccupancyGrid room(bool door) {
  Grid<std::uint8_t> map({{0.0, 0.0}, 0.05, 80, 80}, free_cell);
  for (int i = 0; i < 80; ++i) {
    for (const Cell cell : {Cell{i, 0}, Cell{i, 79}, Cell{0, i}, Cell{79, i}}) map[cell] = occupied_cell;
    if (!door || i < 60) map[{40, i}] = occupied_cell;
  }
  return map_message(map, 1.0, "map");
}

TEST(PlannerNode, SendsAPathThatIsCheckedOrTheFault) {
  PlannerNode planner({});
  give(planner, "/tf", place(1.0, {{1.0, 1.0}, 0.0}), 1.0);
  give(planner, "goal_pose", stamped(1.0, {{3.0, 1.0}, 1.5}), 1.0);
  planner.tick(1.0);
  EXPECT_EQ(planner.status().sentence, "a goal has come, and no map");
  give(planner, "map", room(true), 1.1);
  planner.tick(1.1);
  const auto path = newest<nav_msgs::Path>(planner, "plan");
  ASSERT_TRUE(path);
  ASSERT_GE(path->poses.size(), 3U);
  EXPECT_NEAR(path->poses.back().pose.position.x, 3.0, 0.05);
  EXPECT_NEAR(heading_of(path->poses.back().pose.orientation), 1.5, 1e-9);
  EXPECT_EQ(planner.status().state, "planned");
  auto closed = room(false);
  closed.header = header_of(2.0, "map");
  give(planner, "map", closed, 2.5);
  planner.tick(2.5);
  EXPECT_FALSE(newest<nav_msgs::Path>(planner, "plan"));
  EXPECT_EQ(planner.status().state, "no_path");
}

class Follower : public ::testing::Test {
 protected:
  /// Everything that the follower needs comes at that time, and a wall `ahead_m` ahead of the robot.
  void feed(double time_s, double ahead_m) {
    give(
        *follower, "/tf_static",
        [] {
          tf2_msgs::TFMessage mount;
          mount.transforms = {transform_of(0.0, {}, "base_link", "laser")};
          return mount;
        }(),
        time_s);
    give(*follower, "/tf", place(time_s, {}), time_s);
    nav_msgs::Odometry odometry;
    odometry.header = header_of(time_s, "odom");
    give(*follower, "odom", odometry, time_s);
    sensor_msgs::LaserScan scan;
    scan.header = header_of(time_s, "laser");
    scan.angle_min = -0.5F;
    scan.angle_increment = 0.01F;
    scan.range_min = 0.1F;
    scan.range_max = 10.0F;
    scan.ranges.assign(100, static_cast<float>(ahead_m));
    give(*follower, "scan", scan, time_s);
  }
  double commanded(double time_s) {
    follower->tick(time_s);
    const auto command = newest<geometry_msgs::TwistStamped>(*follower, "cmd_vel");
    return command ? command->twist.linear.x : -1.0;
  }

  void start(const FollowerNodeOptions& options) { follower = std::make_unique<FollowerNode>(options); }

  std::unique_ptr<FollowerNode> follower = std::make_unique<FollowerNode>(FollowerNodeOptions());
};

TEST_F(Follower, DrivesAlongThePathAndStopsForTheNewestScan) {
  feed(1.0, 5.0);
  give(*follower, "plan", path_of(1.0, {{0.0, 0.0}, {3.0, 0.0}}), 1.0);
  EXPECT_GT(commanded(1.0), 0.1);
  feed(1.05, 0.13);
  EXPECT_EQ(commanded(1.05), 0.0);
  feed(1.1, 5.0);
  EXPECT_GT(commanded(1.1), 0.1);
}

TEST_F(Follower, StopsWithinHalfASecondWithoutOdometryAndSaysWhy) {
  feed(1.0, 5.0);
  give(*follower, "plan", path_of(1.0, {{0.0, 0.0}, {3.0, 0.0}}), 1.0);
  EXPECT_GT(commanded(1.0), 0.1);
  EXPECT_GT(commanded(1.35), 0.1);
  EXPECT_EQ(commanded(1.45), 0.0);
  EXPECT_EQ(follower->status().state, "stopped");
  EXPECT_EQ(follower->status().sentence, "no odometry has come for 0.4 s");
  EXPECT_EQ(commanded(3.0), 0.0);
  EXPECT_EQ(commanded(4.0), -1.0);  // others may drive
  feed(5.0, 5.0);
  EXPECT_GT(commanded(5.0), 0.1);
}

TEST_F(Follower, OdometryThatRepeatsItselfIsNotNew) {
  feed(1.0, 5.0);
  give(*follower, "plan", path_of(1.0, {{0.0, 0.0}, {3.0, 0.0}}), 1.0);
  nav_msgs::Odometry frozen;
  frozen.header = header_of(1.0, "odom");
  for (double time_s = 1.0; time_s < 2.0; time_s += 0.05) {
    give(*follower, "odom", frozen, time_s);
    static_cast<void>(commanded(time_s));
  }
  EXPECT_EQ(follower->status().state, "stopped");
}

TEST_F(Follower, StopsWhenTheMapIsTooOldIfAsked) {
  FollowerNodeOptions options;
  options.map_patience_s = 2.0;
  start(options);
  feed(1.0, 5.0);
  give(*follower, "plan", path_of(1.0, {{0.0, 1.0}, {3.0, 1.0}}), 1.0);
  EXPECT_EQ(commanded(1.0), -1.0);
  EXPECT_EQ(follower->status().sentence, "no map has come yet");
  give(*follower, "map", room(true), 1.0);
  feed(2.9, 5.0);
  static_cast<void>(commanded(2.9));
  EXPECT_EQ(follower->status().state, "driving");
  feed(3.1, 5.0);
  static_cast<void>(commanded(3.1));
  EXPECT_EQ(follower->status().sentence, "no map has come for 2 s");
}

TEST(CoverageNode, CoversTheFreeSpaceOfASavedMap) {
  CoverageNodeOptions options;
  options.from_map = true;
  options.cover.problem.width_m = 0.3;
  CoverageNode coverage(options);
  EXPECT_EQ(coverage.status().sentence, "no map has come yet");
  const auto saved = room(true);
  give(coverage, "map", saved, 1.0);
  coverage.tick(1.0);
  EXPECT_EQ(coverage.status().state, "planned") << coverage.status().sentence;
  const auto path = newest<nav_msgs::Path>(coverage, "plan");
  ASSERT_TRUE(path);
  const auto is_free = [&](double x, double y) {
    return saved.data[static_cast<std::size_t>(y / 0.05) * 80 + static_cast<std::size_t>(x / 0.05)] == 0;
  };
  bool left = false, right = false;
  for (const auto& stamped : path->poses) {
    const auto& at = stamped.pose.position;
    for (double turn = 0.0; turn < 6.3; turn += 0.1)
      ASSERT_TRUE(is_free(at.x + 0.149 * std::cos(turn), at.y + 0.149 * std::sin(turn)))
          << at.x << ", " << at.y;
    left = left || at.x < 1.0;
    right = right || at.x > 3.0;
  }
  EXPECT_TRUE(left && right);
  give(coverage, "map", saved, 2.0);
  coverage.tick(2.0);
  EXPECT_FALSE(newest<nav_msgs::Path>(coverage, "plan"));  // the map was sent again
  give(coverage, "map", room(false), 3.0);
  coverage.tick(3.0);
  ASSERT_TRUE(newest<nav_msgs::Path>(coverage, "plan"));
}

TEST(CoverageNode, AFileAndTheMapOfATopicAreNotBothTheArea) {
  CoverageNodeOptions options;
  options.from_map = true;
  options.cover.area = "field.geojson";
  EXPECT_EQ(CoverageNode::checked(options).error().where, "area");
}

TEST(CoverageNode, SendsATrackWithItsProof) {
  CoverageNode coverage({});
  geometry_msgs::PolygonStamped area;
  area.header.frame_id = "map";
  area.polygon.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  give(coverage, "area", area, 1.0);
  coverage.tick(1.0);
  EXPECT_EQ(coverage.status().state, "planned") << coverage.status().sentence;
  const auto path = newest<nav_msgs::Path>(coverage, "plan");
  ASSERT_TRUE(path);
  EXPECT_GT(path->poses.size(), 10U);
  coverage.tick(2.0);
  EXPECT_FALSE(newest<nav_msgs::Path>(coverage, "plan"));
  coverage.tick(7.0);
  EXPECT_TRUE(newest<nav_msgs::Path>(coverage, "plan"));
}

TEST(FaultyLink, LosesAsManyAsStatedAndKeepsTheOrder) {
  FaultyLink<int> link({.loss = 0.25, .delay_s = 0.1}, Rng(3));
  for (int i = 0; i < 10'000; ++i) link.push(0.001 * i, i);
  EXPECT_FALSE(link.take(0.09));
  int count = 0, last = -1;
  while (const auto taken = link.take(100.0)) {
    EXPECT_GT(*taken, last);
    last = *taken;
    ++count;
  }
  EXPECT_NEAR(count, 7500, 150);
}

}  // namespace
}  // namespace outrider
