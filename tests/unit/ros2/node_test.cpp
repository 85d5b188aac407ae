// Two nodes in one process, in a domain of their own and on this machine alone.
#include "outrider/ros2/node.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "outrider/log/encoding/codecs.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/ros2/service.hpp"
#include "support/eventually.hpp"

namespace outrider {
namespace {

using testing::eventually;

RosNode node() {
  auto made = RosNode::open({100 + getpid() % 100, true});
  EXPECT_TRUE(made) << to_string(made.error());
  return std::move(*made);
}

geometry_msgs::Point point(double x) {
  geometry_msgs::Point made;
  made.x = x;
  return made;
}

double x_of_next(RosReader& reader) {
  geometry_msgs::Point seen;
  EXPECT_TRUE(eventually([&] { return reader.take(&seen).value_or(false); }));
  return seen.x;
}

TEST(RosNode, MessagesArriveInOrderAndToTheBit) {
  RosNode one = node(), other = node();
  auto writer = one.writer("/place", message_type<geometry_msgs::Point>(), Delivery::reliable);
  auto reader = other.reader("/place", message_type<geometry_msgs::Point>(), Delivery::reliable);
  ASSERT_TRUE(writer && reader);
  ASSERT_TRUE(eventually([&] { return writer->readers() == 1 && reader->writers() == 1; }));
  geometry_msgs::Point seen;
  EXPECT_EQ(reader->take(&seen), false);
  for (int i = 0; i < 200; ++i) {
    const geometry_msgs::Point sent = point(0.1 * i);
    ASSERT_TRUE(writer->send(&sent));
    EXPECT_EQ(x_of_next(*reader), 0.1 * i);
  }
}

TEST(RosNode, WhoComesLateGetsTheNewestLatchedMessageAndNoOther) {
  RosNode one = node(), other = node();
  auto latched = one.writer("/map", message_type<geometry_msgs::Point>(), Delivery::latched);
  auto usual = one.writer("/plan", message_type<geometry_msgs::Point>(), Delivery::reliable);
  ASSERT_TRUE(latched && usual);
  for (double x : {1.0, 2.0, 3.0}) {
    const geometry_msgs::Point sent = point(x);
    ASSERT_TRUE(latched->send(&sent));
    ASSERT_TRUE(usual->send(&sent));
  }
  auto late = other.reader("/map", message_type<geometry_msgs::Point>(), Delivery::latched);
  auto none = other.reader("/plan", message_type<geometry_msgs::Point>(), Delivery::reliable);
  ASSERT_TRUE(late && none);
  EXPECT_EQ(x_of_next(*late), 3.0);
  ASSERT_TRUE(eventually([&] { return usual->readers() == 1; }));
  EXPECT_FALSE(none->take_bytes());
  const geometry_msgs::Point now = point(4.0);
  ASSERT_TRUE(usual->send(&now));
  EXPECT_EQ(x_of_next(*none), 4.0);
}

/// A map of 4000 x 4000 cells goes over the network in many fragments.
TEST(RosNode, LargeMessagesArriveWhole) {
  RosNode one = node(), other = node();
  auto writer = one.writer("/map", message_type<nav_msgs::OccupancyGrid>(), Delivery::latched);
  auto reader = other.reader("/map", message_type<nav_msgs::OccupancyGrid>(), Delivery::latched);
  ASSERT_TRUE(writer && reader);
  nav_msgs::OccupancyGrid map;
  map.info.width = map.info.height = 4000;
  map.data.resize(16'000'000);
  for (std::size_t i = 0; i < map.data.size(); ++i) map.data[i] = static_cast<std::int8_t>(i * 7 % 101);
  ASSERT_TRUE(writer->send(&map));
  nav_msgs::OccupancyGrid seen;
  ASSERT_TRUE(eventually([&] { return reader->take(&seen).value_or(false); }));
  EXPECT_EQ(seen.data, map.data);
}

TEST(RosNode, BytesThatAreNoSuchMessageAreRefused) {
  RosNode one = node(), other = node();
  auto writer = one.writer("/place", message_type<geometry_msgs::Point>(), Delivery::reliable);
  auto reader = other.reader("/place", message_type<geometry_msgs::Point>(), Delivery::reliable);
  ASSERT_TRUE(writer && reader);
  ASSERT_TRUE(eventually([&] { return writer->readers() == 1 && reader->writers() == 1; }));
  const std::string whole = encode(MessageEncoding::cdr, point(1.0));
  ASSERT_TRUE(writer->send_bytes(whole.substr(0, whole.size() - 3)));
  ASSERT_TRUE(writer->send_bytes(whole));
  geometry_msgs::Point seen;
  std::optional<Fault> refused;
  ASSERT_TRUE(eventually([&] {
    const auto taken = reader->take(&seen);
    if (!taken) refused = taken.error();
    return taken && *taken;
  }));
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->code, FaultCode::bad_input);
  EXPECT_EQ(seen.x, 1.0);
}

/// DDS tells the reader of it by a sample without content, which must not be read as a message.
TEST(RosNode, AWriterThatLeavesCostsNothing) {
  RosNode other = node();
  auto reader = other.reader("/place", message_type<geometry_msgs::Point>(), Delivery::reliable);
  ASSERT_TRUE(reader);
  for (int i = 0; i < 3; ++i) {
    RosNode one = node();
    auto writer = one.writer("/place", message_type<geometry_msgs::Point>(), Delivery::reliable);
    ASSERT_TRUE(writer);
    ASSERT_TRUE(eventually([&] { return writer->readers() == 1 && reader->writers() == 1; }));
    const geometry_msgs::Point sent = point(i);
    ASSERT_TRUE(writer->send(&sent));
    EXPECT_EQ(x_of_next(*reader), i);
  }
  ASSERT_TRUE(eventually([&] { return reader->writers() == 0; }));
  EXPECT_FALSE(reader->take_bytes());
}

TEST(RosNode, WhoDoesNotReadCostsNothing) {
  RosNode one = node(), other = node();
  auto writer = one.writer("/place", message_type<geometry_msgs::Point>(), Delivery::reliable);
  auto reader = other.reader("/place", message_type<geometry_msgs::Point>(), Delivery::reliable);
  ASSERT_TRUE(writer && reader);
  ASSERT_TRUE(eventually([&] { return writer->readers() == 1 && reader->writers() == 1; }));
  for (int i = 0; i < 5000; ++i) {
    const geometry_msgs::Point sent = point(i);
    ASSERT_TRUE(writer->send(&sent));
  }
  double last = -1.0;
  int taken = 0;
  ASSERT_TRUE(eventually([&] {
    geometry_msgs::Point seen;
    while (reader->take(&seen).value_or(false)) {
      EXPECT_GT(seen.x, last);
      last = seen.x;
      ++taken;
    }
    return last == 4999.0;
  }));
  EXPECT_LE(taken, 5000);
}

TEST(RosNode, OddNamesAndDomainsAreRefused) {
  RosNode one = node();
  EXPECT_EQ(one.writer("/no topic", message_type<geometry_msgs::Point>(), Delivery::reliable).error().code,
            FaultCode::bad_input);
  EXPECT_EQ(RosNode::open({233, false}).error().where, "domain");
  for (const char* domain : {"x", "-1", "7.5", "233"}) {
    setenv("ROS_DOMAIN_ID", domain, 1);
    EXPECT_EQ(ros_environment().error().where, "ROS_DOMAIN_ID") << domain;
  }
  setenv("ROS_DOMAIN_ID", "77", 1);
  setenv("ROS_LOCALHOST_ONLY", "1", 1);
  EXPECT_EQ(ros_environment()->domain, 77);
  EXPECT_TRUE(ros_environment()->localhost_only);
  unsetenv("ROS_DOMAIN_ID");
  unsetenv("ROS_LOCALHOST_ONLY");
  EXPECT_EQ(ros_environment()->domain, 0);
}

/// A client as rmw_cyclonedds makes one: the request follows 16 bytes that name it.
TEST(RosService, AnswersClientsThatNameTheirRequestsInThePayload) {
  RosNode one = node(), other = node();
  double radius_m = 0.105;
  const NodeParameters parameters{{{"robot", "", {{"radius", "m", 0.01, 1.0, "of the robot", &radius_m}}}}};
  std::vector<RosService> services;
  for (NodeService& service : parameters.services())
    services.push_back(RosService::open(one, "/mapper", std::move(service)).value());
  using rcl_interfaces::GetParametersRequest, rcl_interfaces::GetParametersResponse;
  auto requests = other.request_writer("/mapper/get_parameters", message_type<GetParametersRequest>());
  auto replies = other.reply_reader("/mapper/get_parameters", message_type<GetParametersResponse>());
  ASSERT_TRUE(requests && replies);
  ASSERT_TRUE(eventually([&] { return requests->readers() == 1 && replies->writers() == 1; }));
  const std::string id = "client 1request9";
  std::string request = encode(MessageEncoding::cdr, GetParametersRequest{{"robot.radius"}});
  ASSERT_TRUE(requests->send_bytes("none"));  // is left without an answer
  ASSERT_TRUE(requests->send_bytes(request));
  ASSERT_TRUE(requests->send_bytes(request.insert(4, id)));
  std::optional<std::string> reply;
  ASSERT_TRUE(eventually([&] {
    for (RosService& service : services) service.answer();
    reply = replies->take_bytes();
    return reply.has_value();
  }));
  EXPECT_EQ(reply->substr(4, 16), id);
  const auto response = decode<GetParametersResponse>(MessageEncoding::cdr, reply->erase(4, 16));
  ASSERT_TRUE(response);
  EXPECT_EQ(response->values.front().double_value, 0.105);
  EXPECT_FALSE(replies->take_bytes());
}

TEST(RosService, IdsOfBigEndianRequestsAreTurnedRound) {
  const std::string little = encode(MessageEncoding::cdr, point(1.0)).substr(0, 4);
  const NodeService echo{"echo", nullptr, nullptr, [&](std::string_view) { return little + "rest"; }};
  std::string request(4, '\0');
  request += "12345678ABCDEFGH";
  EXPECT_EQ(response_to(request, echo), little + "87654321HGFEDCBArest");
  EXPECT_FALSE(response_to(request.substr(0, 19), echo));
}

}  // namespace
}  // namespace outrider
