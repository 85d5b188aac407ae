#include "outrider/log/encoding/channel_decoder.hpp"

#include <gtest/gtest.h>

#include "outrider/log/messages/ros_sensor_messages.hpp"

namespace outrider {
namespace {

using sensor_msgs::LaserScan;

/// The definition of a scan as ROS 1 distributes it.
constexpr const char* ros1_scan = R"(# Single scan from a planar laser range-finder
Header header            # timestamp in the header is the acquisition time
float32 angle_min        # start angle of the scan [rad]
float32 angle_max
float32 angle_increment
float32 time_increment
float32 scan_time
float32 range_min
float32 range_max
float32[] ranges         # range data [m]
float32[] intensities

================================================================================
MSG: std_msgs/Header
# Standard metadata for higher-level stamped data types.
uint32 seq
#Two-integer timestamp
time stamp
#Frame this data is associated with
string frame_id
)";

Channel ros1_channel(std::string schema) {
  return {"/scan", "sensor_msgs/msg/LaserScan", "ros1", "ros1msg", std::move(schema)};
}

std::string decoder_fault(const Channel& channel) {
  const auto decoder = ChannelDecoder<LaserScan>::of(channel);
  return decoder ? "it was read" : to_string(decoder.error());
}

void expect_fault(const Channel& channel, const char* part) {
  EXPECT_NE(decoder_fault(channel).find(part), std::string::npos) << decoder_fault(channel);
}

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  return text.replace(text.find(old), old.size(), with);
}

TEST(ChannelDecoder, DecodesEveryEncodingOfAChannel) {
  LaserScan scan;
  scan.header = {{1, 2}, "laser"};
  scan.ranges = {1.0F, 2.0F};
  Channel json = channel_of<LaserScan>("/scan");
  json.encoding = "json";
  json.schema_encoding = "jsonschema";
  json.schema =
      R"({"type": "object", "properties": {"ranges": {"type": "array", "items": {"type": "number"}}}})";
  const std::pair<Channel, MessageEncoding> channels[] = {
      {channel_of<LaserScan>("/scan"), MessageEncoding::cdr},
      {ros1_channel(ros1_scan), MessageEncoding::ros1},
      {json, MessageEncoding::json}};
  for (const auto& [channel, encoding] : channels) {
    const auto decoder = ChannelDecoder<LaserScan>::of(channel);
    ASSERT_TRUE(decoder) << to_string(decoder.error());
    LaserScan back;
    const auto done = decoder->decode(encode(encoding, scan), back);
    ASSERT_TRUE(done) << to_string(done.error());
    EXPECT_EQ(back.ranges, scan.ranges);
    EXPECT_EQ(back.header.frame_id, "laser");
    const auto cut = decoder->decode("{\"", back);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().where, "/scan");
  }
}

TEST(ChannelDecoder, WithoutASchemaTheNameOfTheTypeIsBelieved) {
  Channel channel = ros1_channel("");
  EXPECT_TRUE(ChannelDecoder<LaserScan>::of(channel));
  channel.type = "sensor_msgs/LaserScan";
  EXPECT_TRUE(ChannelDecoder<LaserScan>::of(channel));
  channel.type = "sensor_msgs/msg/PointCloud2";
  expect_fault(channel,
               "/scan: its messages are sensor_msgs/msg/PointCloud2, and not sensor_msgs/msg/LaserScan");
}

TEST(ChannelDecoder, OtherEncodingsAreRefused) {
  Channel channel = channel_of<LaserScan>("/scan");
  channel.encoding = "protobuf";
  expect_fault(channel, "encoded as 'protobuf'; only cdr, ros1 and json are read");
}

TEST(ChannelDecoder, ASchemaThatLiesIsRefusedWithTheField) {
  const auto changed = [](const char* old, const char* with) {
    return ros1_channel(replaced(ros1_scan, old, with));
  };
  expect_fault(changed("float32 angle_max", "float64 angle_max"),
               "field 3 of its sensor_msgs/LaserScan is 'float64 angle_max', and not 'float32 angle_max'");
  expect_fault(changed("float32 angle_max\n", ""), "'float32 angle_increment', and not 'float32 angle_max'");
  expect_fault(changed("float32[] intensities", ""), "has no field 'float32[] intensities'");
  expect_fault(changed("float32[] intensities", "float32[] intensities\nuint8 more"),
               "one more field, 'uint8 more'");
  expect_fault(changed("float32[] ranges", "float32[360] ranges"), "'float32[360] ranges', and not");
  expect_fault(changed("uint32 seq", "uint8 seq"), "its Header has no 'seq'");
  expect_fault(changed("MSG: std_msgs/Header", "MSG: my_msgs/Header"), "it does not define std_msgs/Header");
  expect_fault(changed("time stamp", "stamp"), "is no field: 'stamp'");
  expect_fault(changed("float32 scan_time", "float32[3 scan_time"), "is no field");
  expect_fault(ros1_channel(std::string(2U << 20U, '\n')), "more than the");
  Channel json =
      ros1_channel(R"({"properties": {"ranges": {"type": "array", "items": {"type": "string"}}}})");
  json.encoding = "json";
  json.schema_encoding = "jsonschema";
  expect_fault(json, "'ranges': it is of the type string");
  json.schema = "[";
  expect_fault(json, "it is no JSON object");
}

TEST(ChannelDecoder, ConstantsDefaultsAndBoundsAreNoDifference) {
  Channel channel = channel_of<rcl_interfaces::Log>("/rosout");
  EXPECT_TRUE(ChannelDecoder<rcl_interfaces::Log>::of(channel));
  channel = channel_of<std_msgs::Header>("/h");
  channel.schema = "int32 A=1\nstring B = \"# x\"\nbuiltin_interfaces/Time stamp\nstring<=8 frame_id 'a=b'\n";
  EXPECT_TRUE(ChannelDecoder<std_msgs::Header>::of(channel))
      << to_string(ChannelDecoder<std_msgs::Header>::of(channel).error());
}

TEST(ChannelDecoder, EveryTypeAgreesWithItsOwnSchema) {
  const auto agrees = []<class Message>(Message) {
    const auto decoder = ChannelDecoder<Message>::of(channel_of<Message>("/a"));
    EXPECT_TRUE(decoder) << to_string(decoder.error());
  };
  agrees(LaserScan{});
  agrees(nav_msgs::Odometry{});
  agrees(tf2_msgs::TFMessage{});
  agrees(nav_msgs::OccupancyGrid{});
  agrees(sensor_msgs::CameraInfo{});
  agrees(geometry_msgs::PoseWithCovarianceStamped{});
}

}  // namespace
}  // namespace outrider
