#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/core/base64.hpp"
#include "outrider/log/encoding/codecs.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"

namespace outrider {
namespace {

template <class Message>
Outcome<Message> from_json(std::string_view text) {
  return decode<Message>(MessageEncoding::json, text);
}

template <class Message>
std::string json_fault(std::string_view text) {
  const auto message = from_json<Message>(text);
  return message ? "it was read" : message.error().sentence;
}

TEST(JsonCodec, AMessageIsItsFieldsUnderTheirNames) {
  const std_msgs::Header header{{1, 2}, "la\"ser"};
  const std::string text = R"({"stamp":{"sec":1,"nanosec":2},"frame_id":"la\"ser"})";
  EXPECT_EQ(encode(MessageEncoding::json, header), text);
  const auto back = from_json<std_msgs::Header>(text);
  ASSERT_TRUE(back) << back.error().sentence;
  EXPECT_EQ(back->stamp.nanosec, 2U);
  EXPECT_EQ(back->frame_id, "la\"ser");
}

TEST(JsonCodec, NumbersComeBackBitByBit) {
  sensor_msgs::LaserScan scan;
  constexpr float inf = std::numeric_limits<float>::infinity();
  scan.ranges = {0.1F, std::nextafter(3.0F, 4.0F), inf, -inf, std::numeric_limits<float>::denorm_min()};
  scan.angle_min = -0.0F;
  sensor_msgs::CameraInfo camera;
  camera.k[4] = std::nextafter(1.0, 2.0);
  camera.d = {1e300, -5e-324};
  const auto scan_back = from_json<sensor_msgs::LaserScan>(encode(MessageEncoding::json, scan));
  const auto camera_back = from_json<sensor_msgs::CameraInfo>(encode(MessageEncoding::json, camera));
  ASSERT_TRUE(scan_back && camera_back);
  EXPECT_EQ(encode(MessageEncoding::cdr, *scan_back), encode(MessageEncoding::cdr, scan));
  EXPECT_EQ(encode(MessageEncoding::cdr, *camera_back), encode(MessageEncoding::cdr, camera));
}

TEST(JsonCodec, TheNamesOfRos1AreRead) {
  const auto header =
      from_json<std_msgs::Header>(R"({"seq": 7, "stamp": {"secs": 1, "nsecs": 2}, "frame_id": "laser"})");
  ASSERT_TRUE(header) << header.error().sentence;
  EXPECT_EQ(header->stamp.sec, 1);
  sensor_msgs::CameraInfo camera;
  camera.d = {0.5};
  std::string text = encode(MessageEncoding::json, camera);
  for (const char* name : {"\"d\"", "\"k\"", "\"r\"", "\"p\""}) text[text.find(name) + 1] -= 'a' - 'A';
  const auto back = from_json<sensor_msgs::CameraInfo>(text);
  ASSERT_TRUE(back) << back.error().sentence;
  EXPECT_EQ(back->d, std::vector<double>{0.5});
}

TEST(JsonCodec, NullIsNoNumber) {
  const auto point = from_json<geometry_msgs::Point>(R"({"x": null, "y": "Infinity", "z": 3})");
  ASSERT_TRUE(point) << point.error().sentence;
  EXPECT_TRUE(std::isnan(point->x));
  EXPECT_EQ(point->y, std::numeric_limits<double>::infinity());
  EXPECT_EQ(point->z, 3.0);
}

TEST(JsonCodec, WhatIsWrongIsNamed) {
  using builtin_interfaces::Time;
  using std_msgs::Header;
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(json_fault<Time>(R"({"sec": 1})"), "it has no field 'nanosec'");
  has(json_fault<Time>(R"({"sec": 1, "nanosec": -1})"), "'nanosec' is a negative number that does not fit");
  has(json_fault<Time>(R"({"sec": 1.5, "nanosec": 1})"), "'sec' is a number that does not fit");
  has(json_fault<Time>(R"({"sec": 3000000000, "nanosec": 1})"), "'sec' is a number that does not fit");
  has(json_fault<Time>(R"({"sec": null, "nanosec": 1})"), "'sec' is null");
  has(json_fault<Time>(R"({"sec": 1, "nanosec": 1, "more": 1})"), "the field 'more', which");
  has(json_fault<Time>(R"({"sec": 1, "sec": 1, "nanosec": 1})"), "'sec' is there twice");
  has(json_fault<Time>(R"({"sec": [1], "nanosec": 1})"), "'sec' is a list");
  has(json_fault<Time>("[1, 2]"), "it is no JSON object");
  has(json_fault<Time>("7"), "it is no JSON object");
  has(json_fault<Time>(R"({"sec": 1,)"), "it is not JSON from byte");
  has(json_fault<Time>(R"({"sec": 1, "nanosec": 1} tail)"), "it is not JSON from byte");
  has(json_fault<Header>(R"({"stamp": 1, "frame_id": ""})"), "'stamp' is a number");
  has(json_fault<Header>(R"({"stamp": {"sec": "x", "nanosec": 1}, "frame_id": ""})"),
      "'stamp.sec' is a text");
  has(json_fault<Header>(R"({"seq": {}, "frame_id": ""})"), "'seq' of a header is no number");
  has(json_fault<sensor_msgs::JointState>(R"({"name": ["a", 1]})"), "'name[1]' is a number");
  has(json_fault<tf2_msgs::TFMessage>(R"({"transforms": [{}]})"), "it has no field 'header'");
}

TEST(JsonCodec, AnArrayHasItsLength) {
  sensor_msgs::CameraInfo camera;
  std::string text = encode(MessageEncoding::json, camera);
  const std::size_t k = text.find("\"k\":[") + 5;
  const auto with = [&](const std::string& more) { return std::string(text).insert(k, more); };
  EXPECT_NE(json_fault<sensor_msgs::CameraInfo>(with("1,")).find("more than 9"), std::string::npos);
  EXPECT_NE(json_fault<sensor_msgs::CameraInfo>(std::string(text).erase(k, 2)).find("a list of 8, where 9"),
            std::string::npos);
}

TEST(Base64, BytesComeBack) {
  std::string bytes;
  for (int i = 0; i < 260; ++i) {
    EXPECT_EQ(base64_decoded(base64_encoded(bytes)), bytes);
    bytes += static_cast<char>(i * 37);
  }
  EXPECT_EQ(base64_encoded("Man"), "TWFu");
  EXPECT_EQ(base64_encoded("M"), "TQ==");
  for (const char* wrong : {"TQ=", "T===", "TQ!=", "=QAA", "T=QA"})
    EXPECT_FALSE(base64_decoded(wrong)) << wrong;
}

}  // namespace
}  // namespace outrider
