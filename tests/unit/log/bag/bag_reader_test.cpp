#include <gtest/gtest.h>

#include <algorithm>

#include "formats.hpp"
#include "outrider/core/rng.hpp"
#include "support/bag_writer.hpp"
#include "support/read_log.hpp"

namespace outrider {
namespace {

using test::BagMessage;
using test::BagWriter;
using test::ReadLog;
using test::ReadMessage;

const std::vector<std::string> bag_topics = {"/scan", "/odom", "/tf"};

BagWriter writer_of(const std::string& compression) {
  BagWriter writer;
  writer.compression = compression;
  writer.add_connection("/scan", "sensor_msgs/LaserScan");
  writer.add_connection("/odom", "nav_msgs/Odometry");
  writer.add_connection("/tf", "tf2_msgs/TFMessage");
  return writer;
}

ReadLog read_bag(const std::string& bag, const LogSelection& selection = {}) {
  return test::read_all(open_bag(memory_source(bag, "run.bag"), selection));
}

/// Chunks whose times overlap, out of order within, with equal times.
struct RandomBag {
  BagWriter writer;
  std::vector<ReadMessage> messages;  ///< in the order a reader returns them

  RandomBag(const std::string& compression, std::uint64_t seed) : writer(writer_of(compression)) {
    Rng rng(seed);
    for (int chunk = 0; chunk < 12; ++chunk) {
      std::vector<BagMessage> written;
      for (int i = 0; i < 20; ++i) {
        const auto connection = static_cast<std::uint32_t>(rng.uniform(0.0, 2.999));
        const std::int64_t time =
            1'600'000'000'000'000'000 + 30 * chunk + static_cast<int>(rng.uniform(0, 99));
        written.push_back({connection, time, std::to_string(chunk) + ":" + std::to_string(i)});
        messages.push_back({bag_topics[connection], time, written.back().data});
      }
      writer.add_chunk(written);
    }
    std::stable_sort(messages.begin(), messages.end(),
                     [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  }
};

TEST(BagReader, ReturnsTheMessagesOfOverlappingChunksInTheOrderOfTime) {
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const RandomBag bag(compression, seed);
      for (const bool with_index : {true, false}) {
        const ReadLog log = read_bag(bag.writer.bytes(with_index));
        EXPECT_EQ(log.fault, "");
        EXPECT_EQ(log.messages, bag.messages) << compression << " " << seed;
        EXPECT_EQ(log.cut_short.empty(), with_index) << log.cut_short;
      }
    }
  }
}

TEST(BagReader, ASelectionIsAFilterOfAllMessages) {
  Rng rng(7);
  const RandomBag bag("lz4", 3);
  for (int i = 0; i < 200; ++i) {
    LogSelection selection;
    for (const std::string& topic : bag_topics) {
      if (rng.uniform(0, 1) < 0.5) selection.topics.push_back(topic);
    }
    selection.from_ns = 1'600'000'000'000'000'000 + static_cast<int>(rng.uniform(-50, 450));
    if (i % 3 > 0) selection.to_ns = selection.from_ns + static_cast<int>(rng.uniform(0, 200));
    EXPECT_EQ(read_bag(bag.writer.bytes(i % 2 == 0), selection).messages,
              test::filter(bag.messages, selection));
  }
}

TEST(BagReader, AConnectionIsAChannel) {
  BagWriter writer = writer_of("none");
  writer.add_connection("/tf", "tf2_msgs/TFMessage");  // a second sender of the same topic
  writer.add_chunk({{2, 5, "a"}, {3, 6, "b"}});
  const std::string bag = writer.bytes();
  const auto reader = open_bag(memory_source(bag, "run.bag"));
  ASSERT_TRUE(reader) << to_string(reader.error());
  ASSERT_EQ((*reader)->channels().size(), 3U);
  const Channel& scan = (*reader)->channels()[0];
  EXPECT_EQ(scan.topic, "/scan");
  EXPECT_EQ(scan.type, "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(scan.encoding, "ros1");
  EXPECT_EQ(scan.schema_encoding, "ros1msg");
  EXPECT_EQ(scan.schema, "# sensor_msgs/LaserScan\nfloat64 x\n");
  EXPECT_EQ(scan.metadata.at("md5sum"), "0123456789abcdef0123456789abcdef");
  EXPECT_EQ(test::read_all(reader).messages, (std::vector<ReadMessage>{{"/tf", 5, "a"}, {"/tf", 6, "b"}}));
}

TEST(BagReader, ChunksWithoutSelectedMessagesAreNotRead) {
  BagWriter writer = writer_of("bz2");
  writer.add_chunk({{0, 10, "scan"}});
  writer.add_packed("damaged", 100, {{1, 10, "odom"}});
  writer.add_packed("damaged", 100, {{0, 20, "scan"}});
  const LogSelection selection{.topics = {"/scan"}, .to_ns = 15};
  const ReadLog log = read_bag(writer.bytes(), selection);
  EXPECT_EQ(log.fault, "");
  EXPECT_EQ(log.messages.size(), 1U);
  const ReadLog all = read_bag(writer.bytes());
  EXPECT_NE(all.fault.find("run.bag, byte "), std::string::npos) << all.fault;
  EXPECT_NE(all.fault.find("bz2 data are damaged"), std::string::npos) << all.fault;
}

TEST(BagReader, ABagCutAnywhereIsReadUpToItsLastCompleteChunk) {
  BagWriter writer = writer_of("lz4");
  std::vector<std::size_t> ends = {0};  // of the chunks
  std::vector<ReadMessage> all;
  for (int i = 0; i < 3; ++i) {
    writer.add_chunk({{0, 10 * i, "a"}, {1, 10 * i + 1, "b"}});
    all.push_back({"/scan", 10 * i, "a"});
    all.push_back({"/odom", 10 * i + 1, "b"});
    const std::size_t index_record = 4 + 4 * 4 + 7 + 8 + 9 + 4 + 4;
    ends.push_back(writer.bytes(false).size() - index_record);
  }
  const std::string bag = writer.bytes();
  for (std::size_t length = 0; length < bag.size(); ++length) {
    const ReadLog log = read_bag(bag.substr(0, length));
    if (length < BagWriter::first_chunk) {
      EXPECT_NE(log.fault, "") << length;
      continue;
    }
    EXPECT_EQ(log.fault, "") << length;
    EXPECT_NE(log.cut_short.find("The end of run.bag is missing"), std::string::npos) << length;
    EXPECT_EQ(log.messages.size() % 2, 0U);
    EXPECT_TRUE(std::equal(log.messages.begin(), log.messages.end(), all.begin())) << length;
    if (length >= ends[1] + 100) {
      EXPECT_GE(log.messages.size(), 2U) << length;
    }
    if (length >= ends[3] + 100) {
      EXPECT_EQ(log.messages.size(), 6U) << length;
    }
  }
  EXPECT_EQ(read_bag(bag).cut_short, "");
}

TEST(BagReader, AFlippedBitIsNoCrashAndNoDisorder) {
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    BagWriter writer = writer_of(compression);
    writer.add_chunk({{0, 10, "a"}, {1, 30, "b"}});
    writer.add_chunk({{0, 20, "c"}, {2, 40, "d"}});
    const std::string bag = writer.bytes();
    for (std::size_t bit = 0; bit < bag.size() * 8; ++bit) {
      std::string flipped = bag;
      flipped[bit / 8] = static_cast<char>(static_cast<unsigned char>(flipped[bit / 8]) ^ (1U << (bit % 8)));
      const ReadLog log = read_bag(flipped);
      EXPECT_TRUE(std::is_sorted(log.messages.begin(), log.messages.end(), [](const auto& a, const auto& b) {
        return a.time_ns < b.time_ns;
      })) << bit;
      EXPECT_LE(log.messages.size(), 4U);
    }
  }
}

TEST(BagReader, AChunkHasTheSizeThatItStates) {
  const std::string zeros(std::size_t{64} << 20, '\0');
  for (const std::string compression : {"bz2", "lz4"}) {
    BagWriter bomb = writer_of(compression);
    bomb.add_packed(compression == "bz2" ? test::pack_bz2(zeros) : test::pack_lz4(zeros), 1000, {{0, 1, ""}});
    EXPECT_NE(read_bag(bomb.bytes()).fault.find("longer than the stated 1000 bytes"), std::string::npos);
    BagWriter boast = writer_of(compression);
    boast.add_packed(compression == "bz2" ? test::pack_bz2("ab") : test::pack_lz4("ab"), 200U << 20,
                     {{0, 1, ""}});
    EXPECT_NE(read_bag(boast.bytes()).fault.find("not the stated 209715200"), std::string::npos);
    BagWriter huge = writer_of(compression);
    huge.add_packed("", 0xffffffffU, {{0, 1, ""}});
    EXPECT_NE(read_bag(huge.bytes()).fault.find("268435456 are the most"), std::string::npos);
  }
}

TEST(BagReader, ManyConnectionsWithLongDefinitionsAreRefused) {
  BagWriter many = writer_of("lz4");
  for (int i = 0; i < 33; ++i)
    many.add_connection("/" + std::to_string(i), "a/B", std::string(1U << 20U, '\n'));
  many.add_chunk({{0, 1, "a"}});
  EXPECT_NE(read_bag(many.bytes()).fault.find("more than 33554432 bytes"), std::string::npos);
}

TEST(BagReader, RefusesWithASentence) {
  BagWriter encrypted = writer_of("none");
  encrypted.header_extra = {{"encryptor", "rosbag/AesCbcEncryptor"}};
  EXPECT_NE(read_bag(encrypted.bytes()).fault.find("encrypted by rosbag/AesCbcEncryptor"), std::string::npos);

  BagWriter unknown = writer_of("none");
  unknown.add_chunk({{0, 1, "a"}, {9, 1, "b"}});
  EXPECT_NE(read_bag(unknown.bytes()).fault.find("connection 9 is unknown"), std::string::npos);

  BagWriter liar = writer_of("none");
  const std::string message =
      test::bag_record(2, {{"conn", test::little(0, 4)}, {"time", test::bag_time(5)}}, "");
  liar.add_packed(message, message.size(), {{0, 7, ""}});
  EXPECT_NE(read_bag(liar.bytes()).fault.find("not among those that the index states"), std::string::npos);

  BagWriter zip = writer_of("zip");
  zip.add_chunk({{0, 1, "a"}});
  EXPECT_NE(read_bag(zip.bytes()).fault.find("compressed as 'zip'"), std::string::npos);
}

TEST(BagReader, AChunkThatWasNeverFinishedEndsTheBag) {
  BagWriter writer = writer_of("none");
  writer.add_chunk({{0, 1, "a"}});
  std::string bag = writer.bytes(false);
  bag += test::bag_record(5, {{"compression", "none"}, {"size", test::little(0, 4)}}, "");
  bag += test::bag_record(2, {{"conn", test::little(0, 4)}, {"time", test::bag_time(2)}}, "b");
  const ReadLog log = read_bag(bag);
  EXPECT_EQ(log.messages.size(), 1U);
  EXPECT_NE(log.cut_short.find("stopped while it wrote a chunk"), std::string::npos) << log.cut_short;
}

}  // namespace
}  // namespace outrider
