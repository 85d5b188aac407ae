#include "outrider/log/encoding/codecs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "outrider/log/messages/ros_marker_messages.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"

namespace outrider {
namespace {

constexpr std::array encodings = {MessageEncoding::cdr, MessageEncoding::ros1, MessageEncoding::json};

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

sensor_msgs::LaserScan sample_scan() {
  sensor_msgs::LaserScan sample_scan;
  sample_scan.header = {{12, 345}, "laser"};
  sample_scan.angle_min = -1.5F;
  sample_scan.range_max = 30.0F;
  sample_scan.ranges = {1.0F, 2.5F, 4.0F};
  return sample_scan;
}

tf2_msgs::TFMessage frames() {
  tf2_msgs::TFMessage message;
  message.transforms.resize(2);
  message.transforms[0].child_frame_id = "odom";
  message.transforms[1].header = {{-3, 7}, "a frame"};
  message.transforms[1].transform.translation = {1.0, -2.0, 0.25};
  return message;
}

TEST(Codecs, CdrAlignsNumbersAndEndsTextsWithZero) {
  const std_msgs::Header header{{1, 2}, "m"};
  EXPECT_EQ(encode(MessageEncoding::cdr, header),
            bytes({0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 'm', 0}));
  const geometry_msgs::PoseStamped pose{header, {{1.0, 0.0, 0.0}, {}}};
  const std::string encoded = encode(MessageEncoding::cdr, pose);
  ASSERT_EQ(encoded.size(), 4U + 16 + 7 * 8);  // two bytes of padding before the first double
  EXPECT_EQ(encoded.substr(18, 10), bytes({0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f}));
}

TEST(Codecs, Ros1CountsHeadersAndPacksWithoutPadding) {
  const std_msgs::Header header{{1, 2}, "m"};
  EXPECT_EQ(encode(MessageEncoding::ros1, header),
            bytes({0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 'm'}));
}

template <class Message>
void expect_round_trip(const Message& message) {
  for (const MessageEncoding encoding : encodings) {
    const std::string encoded = encode(encoding, message);
    const auto decoded = decode<Message>(encoding, encoded);
    ASSERT_TRUE(decoded) << decoded.error().sentence;
    EXPECT_EQ(encode(encoding, *decoded), encoded);
    for (std::size_t length = 0; length < encoded.size(); ++length) {
      EXPECT_FALSE(decode<Message>(encoding, std::string_view(encoded).substr(0, length))) << length;
    }
    EXPECT_FALSE(decode<Message>(encoding, encoded + "tail"));
  }
}

TEST(Codecs, MessagesComeBackAndCutOnesAreRefused) {
  expect_round_trip(sample_scan());
  expect_round_trip(frames());
  expect_round_trip(nav_msgs::Odometry{{{1, 0}, "odom"}, "base_link", {}, {}});
  expect_round_trip(nav_msgs::Path{{}, std::vector<geometry_msgs::PoseStamped>(3)});
  expect_round_trip(nav_msgs::OccupancyGrid{{}, {{}, 0.05F, 2, 1, {}}, {-1, 100}});
  expect_round_trip(map_msgs::OccupancyGridUpdate{{}, 4, 5, 1, 1, {0}});
  expect_round_trip(geometry_msgs::PoseWithCovarianceStamped{});
  visualization_msgs::Marker marker;
  marker.ns = "walls";
  marker.points = {{1, 2, 3}};
  marker.text = "a";
  expect_round_trip(visualization_msgs::MarkerArray{{marker, marker}});
  expect_round_trip(rcl_interfaces::Log{{}, 30, "guard", "the tank is empty", "", "", 0});
}

TEST(Codecs, DecodedFieldsAreThoseEncoded) {
  const auto back =
      decode<sensor_msgs::LaserScan>(MessageEncoding::cdr, encode(MessageEncoding::cdr, sample_scan()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->header.stamp.sec, 12);
  EXPECT_EQ(back->header.stamp.nanosec, 345U);
  EXPECT_EQ(back->header.frame_id, "laser");
  EXPECT_EQ(back->angle_min, -1.5F);
  EXPECT_EQ(back->range_max, 30.0F);
  EXPECT_EQ(back->ranges, (std::vector<float>{1.0F, 2.5F, 4.0F}));
  EXPECT_TRUE(back->intensities.empty());
}

TEST(Codecs, ALengthIsNotBelievedWithoutBytes) {
  tf2_msgs::TFMessage message;
  const auto boast = [&](const std::string& head) {
    return decode(head.size() == 8 ? MessageEncoding::cdr : MessageEncoding::ros1,
                  message_type<tf2_msgs::TFMessage>(), head, &message);
  };
  EXPECT_FALSE(boast(bytes({0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff})));
  EXPECT_FALSE(boast(bytes({0xff, 0xff, 0xff, 0x7f})));
  EXPECT_LT(message.transforms.capacity(), 100U);
}

TEST(Codecs, OtherEncodingsOfCdrAreRefused) {
  const auto big_endian = decode<std_msgs::Header>(MessageEncoding::cdr, bytes({0, 0, 0, 0, 0, 0, 0, 1}));
  ASSERT_FALSE(big_endian);
  EXPECT_NE(big_endian.error().sentence.find("little-endian"), std::string::npos);
}

TEST(SchemaText, ListsFieldsThenTheTypesUsed) {
  EXPECT_EQ(schema_text(message_type<std_msgs::Header>()),
            "builtin_interfaces/Time stamp\nstring frame_id\n" + std::string(80, '=') +
                "\nMSG: builtin_interfaces/Time\nint32 sec  # s\nuint32 nanosec  # ns\n");
  const std::string odometry = schema_text(message_type<nav_msgs::Odometry>());
  EXPECT_NE(odometry.find("float64[36] covariance\n"), std::string::npos);
  EXPECT_NE(odometry.find("MSG: geometry_msgs/Quaternion\nfloat64 x 0\n"), std::string::npos);
  EXPECT_NE(schema_text(message_type<sensor_msgs::LaserScan>()).find("float32[] ranges  # m\n"),
            std::string::npos);
}

}  // namespace
}  // namespace outrider
