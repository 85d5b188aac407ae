#include "outrider/log/copy_log.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "encoding/ros1_to_cdr.hpp"
#include "formats.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "support/bag_writer.hpp"
#include "support/read_log.hpp"

namespace outrider {
namespace {

const std::string separator = std::string(80, '=') + "\n";
const std::string header = separator + "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";

/// The definition of camera information as ROS 1 has it, with a constant more.
const std::string camera_info =
    "uint8 ANY=1\nHeader header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] "
    "D\nfloat64[9] K\n"
    "float64[9] R\nfloat64[12] P\nuint32 binning_x\nuint32 binning_y\nRegionOfInterest roi\n" +
    header + separator +
    "MSG: sensor_msgs/RegionOfInterest\nuint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool "
    "do_rectify\n";

sensor_msgs::CameraInfo camera() {
  sensor_msgs::CameraInfo info;
  info.header = {{5, 6}, "eye"};
  info.distortion_model = "plumb_bob";
  info.d = {0.1, 0.2, 0.3};
  info.k[8] = 1.0;
  info.roi.do_rectify = true;
  return info;
}

TEST(Ros1ToCdr, TheCdrIsThatOfTheSameMessage) {
  const Channel channel{"/camera_info", "sensor_msgs/msg/CameraInfo", "ros1", "ros1msg", camera_info};
  const auto converter = Ros1ToCdr::of(channel);
  ASSERT_TRUE(converter) << to_string(converter.error());
  const auto cdr = converter->convert(encode(MessageEncoding::ros1, camera()));
  ASSERT_TRUE(cdr) << to_string(cdr.error());
  EXPECT_EQ(*cdr, encode(MessageEncoding::cdr, camera()));
  const auto decoder = ChannelDecoder<sensor_msgs::CameraInfo>::of(converter->channel());
  EXPECT_TRUE(decoder) << to_string(decoder.error());
}

TEST(Ros1ToCdr, CutAndLongMessagesAreRefused) {
  const auto converter =
      Ros1ToCdr::of({"/camera_info", "sensor_msgs/msg/CameraInfo", "ros1", "ros1msg", camera_info});
  const std::string whole = encode(MessageEncoding::ros1, camera());
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(converter->convert(whole.substr(0, length)));
  EXPECT_FALSE(converter->convert(whole + "x"));
}

TEST(Ros1ToCdr, ADefinitionThatGrowsWithoutBytesIsRefused) {
  std::string doubling = "A a\nA b\n";
  for (char c = 'A'; c < 'Z'; ++c) {
    doubling += separator + "MSG: p/" + c + "\n" + static_cast<char>(c + 1) + " a\n" +
                static_cast<char>(c + 1) + " b\n";
  }
  doubling += separator + "MSG: p/Z\n";
  const auto wide = Ros1ToCdr::of({"/a", "p/msg/Root", "ros1", "ros1msg", doubling});
  ASSERT_TRUE(wide) << to_string(wide.error());
  EXPECT_FALSE(wide->convert(""));
  const auto loop = Ros1ToCdr::of({"/a", "p/msg/T", "ros1", "ros1msg", "T t\n"});
  ASSERT_TRUE(loop);
  EXPECT_FALSE(loop->convert(""));
  const auto many =
      Ros1ToCdr::of({"/a", "p/msg/T", "ros1", "ros1msg", "Empty[] t\n" + separator + "MSG: p/Empty\n"});
  ASSERT_TRUE(many);
  EXPECT_FALSE(many->convert("\xff\xff\xff\xff"));
  EXPECT_TRUE(many->convert(std::string("\x02\0\0\0", 4)));
}

/// A definition in which each type holds the next one.
std::string chain_of_types(int count) {
  std::string text = "T1 t\n";
  for (int i = 1; i <= count; ++i) text += fmt::format("{}MSG: p/T{}\nT{} t\n", separator, i, i + 1);
  return text + fmt::format("{}MSG: p/T{}\n", separator, count + 1);
}

TEST(Ros1ToCdr, AChainOfTypesCostsNoStackAndNoSquare) {
  const std::string text = chain_of_types(9000);
  ASSERT_LT(text.size(), std::size_t{1} << 20) << "the most that is read";
  const auto deep = Ros1ToCdr::of({"/a", "p/msg/T", "ros1", "ros1msg", text});
  ASSERT_TRUE(deep) << to_string(deep.error());
  EXPECT_NE(to_string(deep->convert("").error()).find("nest more than 32 deep"), std::string::npos);
  const auto shallow = Ros1ToCdr::of({"/a", "p/msg/T", "ros1", "ros1msg", chain_of_types(20)});
  EXPECT_TRUE(shallow->convert(""));
  // In short lines as many types fit as a recursion has no stack for.
  std::string dense = "0 a\n";
  for (int i = 0; i < 58'000; ++i) dense += fmt::format("MSG:p/{:x}\n{:x} a\n", i, i + 1);
  const auto longest = Ros1ToCdr::of({"/a", "p/msg/T", "ros1", "ros1msg", dense + "MSG:p/e290\n"});
  EXPECT_TRUE(longest) << to_string(longest.error());
}

TEST(Ros1ToCdr, TypesAreListedBeforeThoseOfTheirFields) {
  const std::string text = "A a\nB b\n" + separator + "MSG: p/A\nC c\n" + separator + "MSG: p/B\nA a\n" +
                           separator + "MSG: p/C\nint8 x\n";
  const auto converter = Ros1ToCdr::of({"/a", "p/msg/T", "ros1", "ros1msg", text});
  ASSERT_TRUE(converter);
  EXPECT_EQ(converter->channel().schema, "p/A a\np/B b\n" + separator + "MSG: p/A\np/C c\n" + separator +
                                             "MSG: p/C\nint8 x\n" + separator + "MSG: p/B\np/A a\n");
}

TEST(Ros1ToCdr, NamesThatWouldGrowWithEachFieldAreRefused) {
  const std::string long_name(300, 'p');
  const auto fault_of = [](const std::string& type, const std::string& schema) {
    return to_string(Ros1ToCdr::of({"/a", type, "ros1", "ros1msg", schema}).error());
  };
  EXPECT_NE(fault_of("p/msg/T", "int8 a\n" + separator + "MSG: " + long_name + "/T\nb b\n")
                .find("its line 3 names"),
            std::string::npos);
  EXPECT_NE(fault_of(long_name + "/msg/T", "b b\n").find("more than 255 bytes"), std::string::npos);
}

TEST(Ros1ToCdr, AnIncompleteSchemaIsRefused) {
  const auto fault_of = [](const std::string& schema) {
    return to_string(Ros1ToCdr::of({"/a", "p/msg/T", "ros1", "ros1msg", schema}).error());
  };
  EXPECT_EQ(fault_of("Other x\n"), "/a: its schema does not define p/Other");
  EXPECT_EQ(fault_of(""), "/a: it has no schema");
  EXPECT_EQ(fault_of("x\n"), "/a: its schema is wrong: its line 1 is no field: 'x'");
  EXPECT_EQ(fault_of("Header h\n" + separator + "MSG: std_msgs/Header\n"),
            "/a: its schema has a Header without 'seq'");
}

TEST(CopyLog, ABagBecomesMcap) {
  test::BagWriter bag;
  bag.add_connection("/camera_info", "sensor_msgs/CameraInfo", camera_info);
  bag.add_connection("/odd", "a/B", "");
  bag.add_chunk({{0, 10, encode(MessageEncoding::ros1, camera())}, {1, 20, "any"}});
  const std::string bytes = bag.bytes();
  auto reader = open_bag(memory_source(bytes, "run.bag"));
  ASSERT_TRUE(reader);
  std::string written;
  auto writer = McapWriter::begin(make_string_sink(written));
  const auto copy = copy_log(**reader, *writer);
  ASSERT_TRUE(copy) << to_string(copy.error());
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(copy->messages, 2U);
  EXPECT_EQ(copy->kept_ros1, std::vector<std::string>{"/odd"});
  const auto log = test::read_all(open_mcap(memory_source(written, "run.mcap")));
  EXPECT_EQ(log.messages,
            (std::vector<test::ReadMessage>{{"/camera_info", 10, encode(MessageEncoding::cdr, camera())},
                                            {"/odd", 20, "any"}}));
  EXPECT_EQ(log.channels[0].schema_encoding, "ros2msg");
  EXPECT_EQ(log.channels[1].encoding, "ros1");
}

}  // namespace
}  // namespace outrider
