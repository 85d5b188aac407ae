#include "outrider/ros2/names.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(RosNames, BelongToNamespaceAndNode) {
  const RosNamespace robot{"/robot_1", "mapper"};
  EXPECT_EQ(resolve_topic("scan"), "/scan");
  EXPECT_EQ(resolve_topic("/scan", robot), "/scan");
  EXPECT_EQ(resolve_topic("scan", robot), "/robot_1/scan");
  EXPECT_EQ(resolve_topic("~/status", robot), "/robot_1/mapper/status");
  EXPECT_EQ(resolve_topic("explore/status"), "/explore/status");
}

TEST(RosNames, AreRefusedAsRosDoes) {
  for (const char* name : {"", "/", "//scan", "/scan/", "/2d", "sc an", "/scan-raw", "~", "~scan", "/a//b"}) {
    const auto refused = resolve_topic(name);
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().code, FaultCode::bad_input);
  }
}

TEST(RosNames, AreRenamed) {
  const auto names = TopicNames::of({"/robot_1", "mapper"}, {"scan:=/lidar", "/tf:=tf", "~/status:=state"});
  ASSERT_TRUE(names);
  EXPECT_EQ(names->name_of("scan"), "/lidar");
  EXPECT_EQ(names->name_of("/scan"), "/scan");
  EXPECT_EQ(names->name_of("/tf"), "/robot_1/tf");
  EXPECT_EQ(names->name_of("~/status"), "/robot_1/state");
  EXPECT_EQ(names->name_of("odom"), "/robot_1/odom");
  for (const char* rule : {"scan", "scan=lidar", ":=/lidar", "scan:=", "scan:=/li dar"}) {
    const auto refused = TopicNames::of({}, {rule});
    ASSERT_FALSE(refused) << rule;
    EXPECT_EQ(refused.error().code, FaultCode::bad_input);
  }
}

TEST(RosNames, OfSpacesAreAbsolute) {
  EXPECT_EQ(resolve_namespace(""), "/");
  EXPECT_EQ(resolve_namespace("/"), "/");
  EXPECT_EQ(resolve_namespace("robot_1"), "/robot_1");
  EXPECT_EQ(resolve_namespace("/fleet/robot_1"), "/fleet/robot_1");
  EXPECT_FALSE(resolve_namespace("robot 1"));
}

TEST(RosNames, HaveOthersOnTheWire) {
  EXPECT_EQ(topic_on_wire("/robot_1/scan"), "rt/robot_1/scan");
  EXPECT_EQ(type_on_wire("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
}

}  // namespace
}  // namespace outrider
