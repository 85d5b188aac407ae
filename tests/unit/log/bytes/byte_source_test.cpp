#include "bytes/byte_source.hpp"

#include <gtest/gtest.h>

#include "bag/bag_chunk.hpp"
#include "mcap/mcap_encode.hpp"
#include "mcap/read/mcap_chunk.hpp"
#include "support/bag_writer.hpp"

namespace outrider {
namespace {

constexpr std::uint64_t any = std::uint64_t{1} << 30U;

TEST(ByteSource, UnpacksFiveHundredTimesItsSizeAndAGibibyte) {
  const auto source = memory_source("0123456789", "log");
  EXPECT_TRUE(source->may_unpack(any));
  EXPECT_TRUE(source->may_unpack(5'000));
  EXPECT_TRUE(source->may_unpack(499));
  EXPECT_FALSE(source->may_unpack(1));
  const auto other = memory_source("0123456789", "log");
  EXPECT_TRUE(other->may_unpack(100));
  EXPECT_FALSE(other->may_unpack(std::numeric_limits<std::uint64_t>::max())) << "sums do not overflow";
}

TEST(ByteSource, ChunksOfBothFormatsCountEachTimeTheyAreUnpacked) {
  std::string mcap;
  mcap::append_chunk(mcap, {0, 1, 100, 0, "", std::string(100, 'x')});
  const auto log = memory_source(mcap, "run.mcap");
  const auto read = [&] { return mcap::read_chunk(*log, 0, mcap.size() - mcap::head_bytes, any); };
  EXPECT_TRUE(read());
  ASSERT_TRUE(log->may_unpack(any + 500 * mcap.size() + 299));
  EXPECT_TRUE(read());
  const auto third = read();
  ASSERT_FALSE(third);
  EXPECT_NE(third.error().sentence.find("more than 500 times the size of the file"), std::string::npos);

  const std::string bag =
      test::bag_record(5, {{"compression", "none"}, {"size", test::little(100, 4)}}, std::string(100, 'x'));
  const auto source = memory_source(bag, "run.bag");
  const auto record = read_bag_record(*source, 0);
  ASSERT_TRUE(record) << to_string(record.error());
  EXPECT_TRUE(unpack_bag_chunk(*source, *record));
  ASSERT_TRUE(source->may_unpack(any + 500 * bag.size() + 299));
  EXPECT_TRUE(unpack_bag_chunk(*source, *record));
  EXPECT_FALSE(unpack_bag_chunk(*source, *record));
}

}  // namespace
}  // namespace outrider
