// Messages that no good node sends: each is refused with a sentence, and the node goes on.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/nodes/coverage_node.hpp"
#include "outrider/nodes/explorer_node.hpp"
#include "outrider/nodes/follower_node.hpp"
#include "outrider/nodes/mapper_node.hpp"
#include "outrider/nodes/planner_node.hpp"

namespace outrider {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t input_of(const Node& node, const std::string& topic) {
  for (std::size_t i = 0; i < node.inputs().size(); ++i) {
    if (node.inputs()[i].name == topic) return i;
  }
  ADD_FAILURE() << topic;
  return 0;
}

/// Returns the sentences that the node tells of a message.
template <class Message>
std::string told(Node& node, const std::string& topic, const Message& message, double time_s = 10.0) {
  static_cast<void>(node.take_events());
  node.receive(input_of(node, topic), encode(MessageEncoding::cdr, message), time_s);
  node.tick(time_s);
  std::string all;
  for (const NodeEvent& event : node.take_events()) all += event.sentence + "\n";
  return all;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

nav_msgs::OccupancyGrid free_map(double time_s = 1.0) {
  return map_message(Grid<std::uint8_t>({{-2.0, -2.0}, 0.05, 80, 80}, free_cell), time_s, "map");
}

TEST(HostileMessages, MapsAreWhole) {
  PlannerNode planner({});
  auto map = free_map();
  map.info.width = map.info.height = 65536;
  map.data.clear();
  EXPECT_TRUE(
      has(told(planner, "map", map),
          "map: a message was ignored, because the map says that it has 65536 x 65536 cells, and comes "
          "with 0"));
  ExplorerNode explorer({});
  EXPECT_TRUE(has(told(explorer, "map", map), "65536 x 65536"));
  FollowerNode follower({});
  EXPECT_TRUE(has(told(follower, "map", map), "65536 x 65536"));
  for (const float resolution : {0.0F, -1.0F, 1e-9F, std::numeric_limits<float>::quiet_NaN()}) {
    map = free_map();
    map.info.resolution = resolution;
    EXPECT_TRUE(has(told(planner, "map", map), "the cells of the map have")) << resolution;
  }
  map = free_map();
  map.info.origin.position.x = nan;
  EXPECT_TRUE(has(told(planner, "map", map), "its position is nan"));
  map = free_map();
  map.info.origin.orientation = quaternion_of(0.3);
  EXPECT_TRUE(has(told(planner, "map", map), "the map is turned by 17.19 degrees"));
  map = free_map();
  map.info.origin.orientation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_TRUE(has(told(planner, "map", map), "whose length is not 1"));
}

/// A new map makes the node forget the one before: it may lie anywhere.
TEST(HostileMessages, MapsThatShrinkOrLieElsewhereAreBegunAnew) {
  Grid<std::uint8_t> half({{-2.0, -2.0}, 0.05, 80, 80}, free_cell);
  for (std::size_t i = 0; i < half.cells.size(); i += 2) half.cells[i] = unknown_cell;
  ExplorerNode explorer({});
  PlannerNode planner({});
  double time_s = 1.0;
  for (const GridFrame& frame : {GridFrame{{-2.0, -2.0}, 0.05, 80, 80}, GridFrame{{-0.5, -0.5}, 0.05, 20, 20},
                                 GridFrame{{9e5, -9e5}, 0.05, 80, 80}, GridFrame{{-9e5, 9e5}, 0.001, 80, 80},
                                 GridFrame{{-2.0, -2.0}, 0.05, 80, 80}}) {
    time_s += 1.0;
    half.frame = frame;
    half.cells.resize(frame.size(), free_cell);
    EXPECT_EQ(told(planner, "map", map_message(half, time_s, "map"), time_s), "");
    static_cast<void>(told(explorer, "map", map_message(half, time_s, "map"), time_s));
  }
}

TEST(HostileMessages, LengthsThatLieAreRefused) {
  MapperNode mapper({});
  sensor_msgs::LaserScan scan;
  scan.ranges = {1.0F, 2.0F};
  std::string bytes = encode(MessageEncoding::cdr, scan);
  for (std::size_t i = 4; i + 4 <= bytes.size(); ++i) {
    std::string lying = bytes;
    lying.replace(i, 4, "\xff\xff\xff\xff");
    mapper.receive(input_of(mapper, "scan"), lying, 1.0);
    mapper.receive(input_of(mapper, "scan"), std::string_view(bytes).substr(0, i), 1.0);
  }
  mapper.tick(1.0);
  EXPECT_FALSE(mapper.take_events().empty());
  EXPECT_EQ(mapper.status().state, "waiting");
}

TEST(HostileMessages, TimeDoesNotGoBack) {
  PlannerNode planner({});
  EXPECT_EQ(told(planner, "map", free_map(9.0)), "");
  EXPECT_TRUE(has(told(planner, "map", free_map(3.0)), "the time goes back from 9.000 s to 3.000 s"));
  nav_msgs::Odometry odometry;
  odometry.header = header_of(5.0, "odom");
  MapperNode mapper({});
  static_cast<void>(told(mapper, "odom", odometry));
  odometry.header = header_of(4.0, "odom");
  EXPECT_TRUE(has(told(mapper, "odom", odometry), "the time goes back"));
  odometry.header.stamp = {-7, 4'000'000'000U};
  EXPECT_TRUE(has(told(mapper, "odom", odometry), "its stamp is -7 s and 4000000000 ns, which is no time"));
}

TEST(HostileMessages, NumbersAreFinite) {
  FollowerNode follower({});
  nav_msgs::Odometry odometry;
  odometry.header = header_of(5.0, "odom");
  odometry.pose.pose.position.x = nan;
  EXPECT_TRUE(has(told(follower, "odom", odometry), "its position is nan"));
  odometry.pose.pose.position.x = 0.0;
  odometry.twist.twist.linear.x = nan;
  EXPECT_TRUE(has(told(follower, "odom", odometry), "its twist is not finite"));
  nav_msgs::Path path = path_of(5.0, {{0.0, 0.0}, {1.0, 1.0}});
  path.poses.back().pose.position.y = nan;
  EXPECT_TRUE(has(told(follower, "plan", path), "its position is 1, nan"));
  PlannerNode planner({});
  EXPECT_TRUE(has(told(planner, "goal_pose", stamped(5.0, {{nan, 0.0}, 0.0})), "its position is nan"));
  EXPECT_TRUE(has(told(planner, "goal_pose", stamped(5.0, {{1e300, 0.0}, 0.0})), "up to 1e+06 m are taken"));
  EXPECT_TRUE(has(told(planner, "goal_pose", stamped(5.0, {}, "moon")), "give it in 'map'"));
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(transform_of(5.0, {{nan, 0.0}, 0.0}, "map", "odom"));
  EXPECT_TRUE(has(told(planner, "/tf", transforms), "is not finite"));
  transforms.transforms[0] = transform_of(5000.0, {}, "map", "odom");
  EXPECT_TRUE(has(told(planner, "/tf", transforms), "ahead of the time of this node"));
}

TEST(HostileMessages, ScansAreScans) {
  MapperNode mapper({});
  sensor_msgs::LaserScan scan;
  scan.header = header_of(5.0, "laser");
  scan.angle_increment = std::numeric_limits<float>::quiet_NaN();
  scan.ranges.resize(10);
  EXPECT_TRUE(has(told(mapper, "scan", scan), "scan: a message was ignored, because"));
  scan.angle_increment = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges.resize(1'000'000, 1.0F);
  EXPECT_TRUE(has(told(mapper, "scan", scan), "scan: a message was ignored, because"));
}

TEST(HostileMessages, AreasArePolygons) {
  CoverageNode coverage({});
  geometry_msgs::PolygonStamped area;
  area.header.frame_id = "map";
  EXPECT_TRUE(has(told(coverage, "area", area), "the area has 0 corners"));
  area.polygon.points = {{0, 0, 0}, {3, 0, 0}, {std::numeric_limits<float>::infinity(), 3, 0}};
  EXPECT_TRUE(has(told(coverage, "area", area), "the area has a corner at inf"));
  area.polygon.points = {{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 3, 0}};  // crosses itself
  EXPECT_TRUE(has(told(coverage, "area", area), "bad_input"));
}

TEST(HostileMessages, SentencesAreNotRepeatedWithoutEnd) {
  PlannerNode planner({});
  auto map = free_map();
  map.data.clear();
  const std::string bytes = encode(MessageEncoding::cdr, map);
  for (int i = 0; i < 1000; ++i) planner.receive(input_of(planner, "map"), bytes, 10.0 + 0.001 * i);
  EXPECT_LE(planner.take_events().size(), 2U);
}

}  // namespace
}  // namespace outrider
