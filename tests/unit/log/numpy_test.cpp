#include "outrider/log/numpy.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "outrider/log/messages/ros_sensor_messages.hpp"

namespace outrider {
namespace {

/// The data of a .npy file, whose head says where they begin.
std::string data_of(const NumpyArray& array) {
  std::uint32_t head = 0;
  std::memcpy(&head, array.bytes.data() + 8, sizeof head);
  return array.bytes.substr(12 + head);
}

std::string head_of(const NumpyArray& array) {
  std::uint32_t head = 0;
  std::memcpy(&head, array.bytes.data() + 8, sizeof head);
  return array.bytes.substr(12, head);
}

template <class Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  Number value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::vector<NumpyArray> arrays_of(const std::vector<sensor_msgs::LaserScan>& scans) {
  NumpyArrays arrays;
  std::int64_t time_ns = 0;
  for (const auto& scan : scans)
    EXPECT_TRUE(arrays.append("/scan", time_ns += 1000, message_type<sensor_msgs::LaserScan>(), &scan));
  return *arrays.finish();
}

TEST(Numpy, TheDtypeHasTheFieldsOfTheMessage) {
  EXPECT_EQ(numpy_dtype(message_type<geometry_msgs::Point>()), "[('x', '<f8'), ('y', '<f8'), ('z', '<f8')]");
  EXPECT_EQ(numpy_dtype(message_type<std_msgs::Header>(), 5),
            "[('stamp', [('sec', '<i4'), ('nanosec', '<u4')]), ('frame_id', '<U5')]");
  EXPECT_NE(
      numpy_dtype(message_type<geometry_msgs::PoseWithCovariance>()).find("('covariance', '<f8', (36,))"),
      std::string::npos);
}

TEST(Numpy, SequencesAreRangesOfAnArrayOfTheirOwn) {
  sensor_msgs::LaserScan one;
  one.ranges = {1.0F, 2.0F};
  sensor_msgs::LaserScan two;
  two.ranges = {3.0F};
  const auto arrays = arrays_of({one, two});
  ASSERT_EQ(arrays.size(), 3U);
  EXPECT_EQ(arrays[0].name, "scan");
  EXPECT_EQ(arrays[0].length, 2U);
  EXPECT_EQ(arrays[1].name, "scan/ranges");
  EXPECT_EQ(arrays[1].length, 3U);
  EXPECT_EQ(arrays[2].name, "scan/intensities");
  EXPECT_EQ(data_of(arrays[1]), std::string("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12));
  // time, stamp, a text of one character, seven floats, and the ranges of two sequences
  const std::size_t record = 8 + 8 + 4 + 7 * 4 + 2 * 16;
  const std::string records = data_of(arrays[0]);
  ASSERT_EQ(records.size(), 2 * record);
  EXPECT_EQ(number_at<std::int64_t>(records, record), 2000);
  EXPECT_EQ(number_at<std::int64_t>(records, record + record - 32), 2);
  EXPECT_EQ(number_at<std::int64_t>(records, record + record - 24), 3);
}

TEST(Numpy, TextsAreAsLongAsTheLongest) {
  sensor_msgs::LaserScan one;
  one.header.frame_id = "a\xC3\xA9\xF0\x9F\x98\x80";  // characters of one, two and four bytes
  sensor_msgs::LaserScan two;
  two.header.frame_id = "\xFF";  // no UTF-8
  const auto arrays = arrays_of({one, two});
  EXPECT_NE(head_of(arrays[0]).find("('frame_id', '<U3')"), std::string::npos) << head_of(arrays[0]);
  const std::string records = data_of(arrays[0]);
  EXPECT_EQ(number_at<char32_t>(records, 16), U'a');
  EXPECT_EQ(number_at<char32_t>(records, 20), U'\u00E9');
  EXPECT_EQ(number_at<char32_t>(records, 24), U'\U0001F600');
  EXPECT_EQ(number_at<char32_t>(records, records.size() / 2 + 16), U'?');
  EXPECT_EQ(number_at<char32_t>(records, records.size() / 2 + 20), U'\0');
}

TEST(Numpy, TheDataBeginAtAMultipleOf64Bytes) {
  for (const NumpyArray& array : arrays_of({{}}))
    EXPECT_EQ((array.bytes.size() - data_of(array).size()) % 64, 0U) << array.name;
}

}  // namespace
}  // namespace outrider
