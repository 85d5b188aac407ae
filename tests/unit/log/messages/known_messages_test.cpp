#include "outrider/log/messages/known_messages.hpp"

#include <gtest/gtest.h>

#include "outrider/log/messages/ros_messages.hpp"

namespace outrider {
namespace {

TEST(KnownMessages, AMessageIsDecodedByTheTypeOfItsChannel) {
  nav_msgs::Odometry odometry;
  odometry.child_frame_id = "base_link";
  auto message = AnyMessage::of(channel_of<nav_msgs::Odometry>("/odom"));
  ASSERT_TRUE(message && *message);
  ASSERT_TRUE((*message)->decode(encode(MessageEncoding::cdr, odometry)));
  EXPECT_EQ((*message)->type().name, "nav_msgs/msg/Odometry");
  EXPECT_EQ(static_cast<const nav_msgs::Odometry*>((*message)->content())->child_frame_id, "base_link");
  EXPECT_FALSE((*message)->decode("short"));
}

TEST(KnownMessages, AnUnknownTypeIsNoFaultAndASchemaThatLiesIsOne) {
  const auto unknown = AnyMessage::of({"/a", "some_msgs/msg/Thing", "cdr", "", ""});
  ASSERT_TRUE(unknown);
  EXPECT_FALSE(unknown->has_value());
  EXPECT_EQ(find_message_type("some_msgs/msg/Thing"), nullptr);
  const auto lies = AnyMessage::of({"/b", "nav_msgs/msg/Odometry", "cdr", "ros2msg", "float64 x\n"});
  ASSERT_FALSE(lies);
  EXPECT_EQ(lies.error().code, FaultCode::bad_input);
}

}  // namespace
}  // namespace outrider
