// Both ways between Outrider and a node on another implementation of DDS, in processes of their own.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <limits>
#include <numeric>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "outrider/log/encoding/codecs.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_marker_messages.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/messages/node_messages.hpp"
#include "outrider/nodes/messages/tag_messages.hpp"
#include "outrider/nodes/planner_node.hpp"
#include "outrider/ros2/node.hpp"
#include "outrider/ros2/run_node.hpp"
#include "support/eventually.hpp"

namespace outrider {
namespace {

using testing::eventually;

using geometry_msgs::Twist;
using nav_msgs::OccupancyGrid;

/// The answers of the peer are latched, and so read: else an answer is lost if the peer has not yet found the
/// reader when it sends.
class FastDds : public ::testing::Test {
 protected:
  void SetUp() override { open(false); }
  void open(bool local) {
    start_peer(local);
    open_node(local);
  }
  void start_peer(bool local) {
    const std::string domain = std::to_string(domain_);
    peer_ = fork();
    ASSERT_GE(peer_, 0);
    if (peer_ == 0) {
      execl(FASTDDS_PEER, FASTDDS_PEER, domain.c_str(), local ? "local" : nullptr, nullptr);
      _exit(127);
    }
  }
  void open_node(bool local) {
    auto node = RosNode::open({domain_, local});
    ASSERT_TRUE(node) << to_string(node.error());
    node_ = std::move(*node);
  }
  void TearDown() override {
    if (peer_ <= 0) return;
    kill(peer_, SIGKILL);
    waitpid(peer_, nullptr, 0);
  }
  RosWriter writer(const std::string& topic, const MessageType& type, Delivery qos) {
    auto made = node_->writer(topic, type, qos);
    EXPECT_TRUE(made) << to_string(made.error());
    return *made;
  }
  RosReader reader(const std::string& topic, const MessageType& type, Delivery qos) {
    auto made = node_->reader(topic, type, qos);
    EXPECT_TRUE(made) << to_string(made.error());
    return *made;
  }

  std::int64_t domain_ = 77;
  pid_t peer_ = 0;
  std::optional<RosNode> node_;
};

TEST_F(FastDds, AnswersWhatItIsAsked) {
  RosWriter asked = writer("/asked", message_type<Twist>(), Delivery::reliable);
  RosReader answered = reader("/answered", message_type<Twist>(), Delivery::latched);
  ASSERT_TRUE(eventually([&] { return asked.readers() == 1 && answered.writers() == 1; }));
  for (int i = 1; i <= 100; ++i) {
    Twist twist;
    twist.linear = {0.1 * i, -0.2 * i, 3.0};
    twist.angular = {0.0, 1e-300, -7.5 * i};
    ASSERT_TRUE(asked.send(&twist));
    Twist answer;
    ASSERT_TRUE(eventually([&] { return answered.take(&answer).value_or(false); })) << i;
    EXPECT_EQ(answer.linear.x, 2.0 * twist.linear.x);
    EXPECT_EQ(answer.linear.y, 2.0 * twist.linear.y);
    EXPECT_EQ(answer.angular.y, 2e-300);
    EXPECT_EQ(answer.angular.z, 2.0 * twist.angular.z);
  }
}

/// The map is sent before anybody listens. Its frame has a length that leaves the fields after it unaligned.
TEST_F(FastDds, GetsALatchedMapOf4000By4000Cells) {
  RosWriter maps = writer("/map", message_type<OccupancyGrid>(), Delivery::latched);
  OccupancyGrid map;
  map.header.frame_id = "map_7";
  map.info.resolution = 0.05F;
  map.info.width = map.info.height = 4000;
  map.info.origin.position.x = -12.5;
  map.data.resize(16'000'000);
  for (std::size_t i = 0; i < map.data.size(); ++i) map.data[i] = static_cast<std::int8_t>(i * 7 % 102) - 1;
  ASSERT_TRUE(maps.send(&map));
  RosReader seen = reader("/map_seen", message_type<Twist>(), Delivery::latched);
  Twist told;
  ASSERT_TRUE(eventually([&] { return seen.take(&told).value_or(false); }));
  EXPECT_EQ(told.linear.x, 4000.0);
  EXPECT_EQ(told.linear.y, 4000.0);
  EXPECT_EQ(told.linear.z, static_cast<double>(0.05F));
  EXPECT_EQ(told.angular.x, -12.5);
  EXPECT_EQ(told.angular.y, 5.0);
  EXPECT_EQ(told.angular.z, std::accumulate(map.data.begin(), map.data.end(), 0.0));
}

/// So `ros2 node list` knows the node, and `ros2 node info` which readers and writers are its own.
TEST_F(FastDds, IsToldWhichNodeReadersAndWritersBelongTo) {
  RosReader seen = reader("/node_seen", message_type<Twist>(), Delivery::latched);
  RosWriter maps = writer("/robot_1/map", message_type<OccupancyGrid>(), Delivery::latched);
  ASSERT_TRUE(node_->announce({"/robot_1", "mapper"}));
  Twist told;
  ASSERT_TRUE(eventually([&] { return seen.take(&told).value_or(false); }));
  EXPECT_EQ(told.linear.x, 1.0);   // node
  EXPECT_EQ(told.linear.y, 6.0);   // letters of "mapper"
  EXPECT_EQ(told.linear.z, 8.0);   // letters of "/robot_1"
  EXPECT_EQ(told.angular.x, 1.0);  // reader
  EXPECT_EQ(told.angular.y, 1.0);  // writer
  EXPECT_EQ(told.angular.z, 1.0);  // all of this participant
}

/// A goal of the peer reaches a planner of ours that runs as a node.
TEST_F(FastDds, SendsAGoalToThePlanner) {
  PlannerNode planner({});
  std::stop_source stop;
  RunNodeOptions options;
  options.network = {domain_, false};
  std::jthread running(
      [&] { EXPECT_TRUE(run_node(planner, options, stop.get_token(), [](const auto&) {})); });
  RosReader status =
      reader("/planner/status", message_type<diagnostic_msgs::DiagnosticStatus>(), Delivery::latched);
  diagnostic_msgs::DiagnosticStatus told;
  EXPECT_TRUE(eventually(
      [&] { return status.take(&told).value_or(false) && told.message == "a goal has come, and no map"; }));
  stop.request_stop();
}

TEST_F(FastDds, IsCommanded) {
  RosWriter commands = writer("/cmd_vel", message_type<geometry_msgs::TwistStamped>(), Delivery::reliable);
  RosReader seen = reader("/command_seen", message_type<Twist>(), Delivery::latched);
  ASSERT_TRUE(eventually([&] { return commands.readers() == 1 && seen.writers() == 1; }));
  geometry_msgs::TwistStamped command;
  command.header.frame_id = "base_link";
  command.twist.linear.x = 0.25;
  command.twist.angular.z = -1.5;
  ASSERT_TRUE(commands.send(&command));
  Twist told;
  ASSERT_TRUE(eventually([&] { return seen.take(&told).value_or(false); }));
  EXPECT_EQ(told.linear.x, 0.25);
  EXPECT_EQ(told.angular.z, -1.5);
}

/// Returns messages of every type of the topics in docs/ros2.md, in the order of the peer, with lengths that
/// leave what follows unaligned.
std::vector<std::pair<const MessageType*, std::string>> one_of_each() {
  std::vector<std::pair<const MessageType*, std::string>> all;
  const auto add = [&](const auto& message) {
    using Message = std::decay_t<decltype(message)>;
    all.emplace_back(&message_type<Message>(), encode(MessageEncoding::cdr, message));
  };
  const std_msgs::Header header = header_of(12.345678901, "frame_7");
  const geometry_msgs::PoseStamped pose = stamped(12.5, {{1.0, -2.0}, 0.5}, "map_1");
  sensor_msgs::LaserScan scan;
  scan.header = header;
  scan.ranges = {1.0F, 2.5F, std::numeric_limits<float>::infinity()};
  add(scan);
  nav_msgs::Odometry odometry;
  odometry.header = header;
  odometry.child_frame_id = "base_link";
  odometry.pose.pose = pose.pose;
  odometry.twist.twist.linear.x = 0.25;
  add(odometry);
  add(tf2_msgs::TFMessage{{transform_of(1.0, {{1.0, 2.0}, 0.1}, "map", "odom"),
                           transform_of(1.5, {{3.0, 4.0}, 0.2}, "odom", "base")}});
  sensor_msgs::CameraInfo camera;
  camera.header = header;
  camera.width = 640;
  camera.distortion_model = "plumb_bob";
  add(camera);
  sensor_msgs::Image image;
  image.header = header;
  image.width = image.step = 5;
  image.height = 3;
  image.encoding = "mono8";
  image.data.assign(15, 200);
  add(image);
  apriltag_msgs::AprilTagDetectionArray tags;
  tags.header = header;
  tags.detections.resize(2);
  tags.detections[1].family = "36h11";
  tags.detections[1].id = 7;
  add(tags);
  add(pose);
  geometry_msgs::PoseWithCovarianceStamped belief;
  belief.header = header;
  belief.pose.pose = pose.pose;
  belief.pose.covariance[35] = 0.125;
  add(belief);
  nav_msgs::OccupancyGrid map;
  map.header = header;
  map.info.width = 3;
  map.info.height = 1;
  map.data = {-1, 0, 100};
  add(map);
  add(path_of(2.0, {{0.0, 0.0}, {1.0, 0.5}, {2.0, 0.0}}, "map"));
  geometry_msgs::PolygonStamped area;
  area.header = header;
  area.polygon.points.resize(3);
  area.polygon.points[1].x = 2.0F;
  add(area);
  visualization_msgs::MarkerArray markers;
  markers.markers.resize(2);
  markers.markers[1].ns = "frontiers";
  add(markers);
  diagnostic_msgs::DiagnosticStatus status;
  status.name = "mapper";
  status.message = "scans are mapped";
  status.values = {{"state", "mapping"}};
  add(status);
  add(rosgraph_msgs::Clock{stamp_of(77.25)});
  rcl_interfaces::Log line;
  line.name = "planner";
  line.msg = "no path";
  add(line);
  sensor_msgs::JointState joints;
  joints.header = header;
  joints.name = {"yaw", "pitch"};
  joints.position = {0.5, -0.25};
  add(joints);
  add(std_msgs::Float64{9.75});
  add(std_msgs::String{"garfield"});
  return all;
}

TEST_F(FastDds, SendsEveryTypeBackAsItCame) {
  const auto all = one_of_each();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [type, bytes] = all[i];
    const std::string topic = "/echo/n" + std::to_string(i);
    RosWriter asked = writer(topic + "/asked", *type, Delivery::reliable);
    RosReader answered = reader(topic + "/answered", *type, Delivery::latched);
    ASSERT_TRUE(eventually([&] { return asked.readers() == 1 && answered.writers() == 1; })) << type->name;
    ASSERT_TRUE(asked.send_bytes(bytes)) << type->name;
    std::optional<std::string> answer;
    ASSERT_TRUE(eventually([&] { return (answer = answered.take_bytes()).has_value(); })) << type->name;
    EXPECT_EQ(answer->substr(0, bytes.size()), bytes) << type->name;
    EXPECT_LT(answer->size(), bytes.size() + 4) << type->name;  // RTPS fills up to 4 bytes
  }
}

/// A peer that stands still does not hold up who sends; what it missed is lost, and it goes on with the
/// newest.
TEST_F(FastDds, StopsReadingAndCostsNothing) {
  RosWriter asked = writer("/asked", message_type<Twist>(), Delivery::reliable);
  RosReader answered = reader("/answered", message_type<Twist>(), Delivery::latched);
  ASSERT_TRUE(eventually([&] { return asked.readers() == 1 && answered.writers() == 1; }));
  kill(peer_, SIGSTOP);
  Twist twist, answer;
  for (int i = 1; i <= 20'000; ++i) {
    twist.linear.x = i;
    ASSERT_TRUE(asked.send(&twist)) << i;
  }
  kill(peer_, SIGCONT);
  EXPECT_TRUE(
      eventually([&] { return answered.take(&answer).value_or(false) && answer.linear.x == 40'000.0; }));
}

/// Both with ROS_LOCALHOST_ONLY=1.
class FastDdsOnThisMachine : public FastDds {
 protected:
  void SetUp() override { domain_ = 78; }  // the process has the other domain already, on all interfaces

  void expect_answer() {
    RosWriter asked = writer("/asked", message_type<Twist>(), Delivery::reliable);
    RosReader answered = reader("/answered", message_type<Twist>(), Delivery::latched);
    ASSERT_TRUE(eventually([&] { return asked.readers() == 1 && answered.writers() == 1; }));
    Twist twist, answer;
    twist.linear.x = 0.5;
    ASSERT_TRUE(asked.send(&twist));
    ASSERT_TRUE(eventually([&] { return answered.take(&answer).value_or(false); }));
    EXPECT_EQ(answer.linear.x, 1.0);
  }
};

TEST_F(FastDdsOnThisMachine, AnswersWhatItIsAsked) {
  open(true);
  expect_answer();
}

/// The node starts when another node knows it already, so it announces itself no more often than it ever
/// does.
TEST_F(FastDdsOnThisMachine, IsFoundAlsoIfItStartsLater) {
  open_node(true);
  auto other = RosNode::open({domain_, true});
  ASSERT_TRUE(other) << to_string(other.error());
  auto heard = other->reader("/early", message_type<Twist>(), Delivery::reliable);
  ASSERT_TRUE(heard) << to_string(heard.error());
  RosWriter early = writer("/early", message_type<Twist>(), Delivery::reliable);
  ASSERT_TRUE(eventually([&] { return early.readers() == 1 && heard->writers() == 1; }));
  start_peer(true);
  expect_answer();
}

}  // namespace
}  // namespace outrider
