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

TEST(RosNames, HaveOthersOnTheWire) {
  EXPECT_EQ(topic_on_wire("/robot_1/scan"), "rt/robot_1/scan");
  EXPECT_EQ(type_on_wire("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
}

}  // namespace
}  // namespace outrider
