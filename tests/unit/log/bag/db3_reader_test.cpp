#include <gtest/gtest.h>

#include <algorithm>

#include "formats.hpp"
#include "outrider/core/rng.hpp"
#include "support/db3_writer.hpp"
#include "support/read_log.hpp"

namespace outrider {
namespace {

using test::Db3Writer;
using test::ReadLog;
using test::ReadMessage;

const std::vector<std::string> db3_topics = {"/scan", "/odom", "/tf"};

ReadLog read_db3(const std::string& bag, const LogSelection& selection = {}) {
  return test::read_all(open_db3_bytes("run.db3", bag, selection));
}

struct RandomDb3 {
  std::string bytes;
  std::vector<ReadMessage> messages;  ///< in the order a reader returns them

  RandomDb3(std::uint64_t seed, int count, bool with_index) {
    Rng rng(seed);
    Db3Writer writer;
    writer.make_tables(false, with_index);
    for (int i = 0; i < 3; ++i)
      writer.add_topic(i + 1, db3_topics[static_cast<std::size_t>(i)], "a/msg/B", false);
    writer.run("BEGIN");
    for (int i = 0; i < count; ++i) {
      const auto topic = static_cast<std::size_t>(rng.uniform(0.0, 2.999));
      const auto time = static_cast<std::int64_t>(rng.uniform(-100.0, 1000.0));
      std::string data(static_cast<std::size_t>(rng.uniform(0, 5000)), static_cast<char>(i));
      writer.add_message(static_cast<std::int64_t>(topic) + 1, time, data);
      messages.push_back({db3_topics[topic], time, std::move(data)});
    }
    writer.run("COMMIT");
    bytes = writer.bytes();
    std::stable_sort(messages.begin(), messages.end(),
                     [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  }
};

TEST(Db3Reader, ReturnsTheMessagesInTheOrderOfTimeWithAndWithoutAnIndex) {
  for (const bool with_index : {true, false}) {
    const RandomDb3 bag(1, 500, with_index);
    const ReadLog log = read_db3(bag.bytes);
    EXPECT_EQ(log.fault, "");
    EXPECT_EQ(log.messages, bag.messages);
  }
}

TEST(Db3Reader, ASelectionIsAFilterOfAllMessages) {
  Rng rng(7);
  const RandomDb3 bag(2, 200, true);
  for (int i = 0; i < 100; ++i) {
    LogSelection selection;
    for (const std::string& topic : db3_topics) {
      if (rng.uniform(0, 1) < 0.5) selection.topics.push_back(topic);
    }
    selection.from_ns = static_cast<std::int64_t>(rng.uniform(-200, 1000));
    if (i % 3 > 0) selection.to_ns = selection.from_ns + static_cast<std::int64_t>(rng.uniform(0, 500));
    EXPECT_EQ(read_db3(bag.bytes, selection).messages, test::filter(bag.messages, selection));
  }
}

TEST(Db3Reader, ATopicIsAChannelWithTheDefinitionOfItsType) {
  for (const bool with_definitions : {true, false}) {
    Db3Writer writer;
    writer.make_tables(with_definitions);
    writer.add_topic(4, "/scan", "sensor_msgs/msg/LaserScan", with_definitions);
    if (with_definitions) {
      writer.run(
          "INSERT INTO message_definitions VALUES(1, 'sensor_msgs/msg/LaserScan', 'ros2msg', 'float32 x', "
          "'')");
    }
    const std::string bytes = writer.bytes();
    const auto reader = open_db3_bytes("run.db3", bytes);
    ASSERT_TRUE(reader) << to_string(reader.error());
    Channel expected{
        "/scan", "sensor_msgs/msg/LaserScan", "cdr", "", "", {{"offered_qos_profiles", "- depth: 10"}}};
    if (with_definitions) {
      expected.schema_encoding = "ros2msg";
      expected.schema = "float32 x";
      expected.metadata["type_description_hash"] = "RIHS01_0";
    }
    EXPECT_EQ((*reader)->channels(), std::vector<Channel>{expected});
  }
}

TEST(Db3Reader, RefusesWithASentence) {
  Db3Writer empty;
  empty.run("CREATE TABLE topics(id INTEGER)");
  EXPECT_NE(read_db3(empty.bytes()).fault.find("without a table 'messages'"), std::string::npos);

  Db3Writer columns;
  columns.run("CREATE TABLE topics(id INTEGER); CREATE TABLE messages(id INTEGER)");
  EXPECT_NE(read_db3(columns.bytes()).fault.find("'topics' has no stored column 'name'"), std::string::npos);

  Db3Writer view;
  view.run("CREATE TABLE topics(id INTEGER); CREATE VIEW messages AS SELECT 1 AS timestamp");
  EXPECT_NE(read_db3(view.bytes()).fault.find("without a table 'messages'"), std::string::npos);

  Db3Writer format;
  format.make_tables(false);
  format.add_topic(1, "/scan", "a/msg/B", false);
  format.add_topic(2, "/odd", "a/msg/B", false, "protobuf");
  format.add_message(1, 5, "a");
  EXPECT_NE(read_db3(format.bytes()).fault.find("messages of /odd are in the format 'protobuf'"),
            std::string::npos);
  EXPECT_EQ(read_db3(format.bytes(), {.topics = {"/scan"}}).messages.size(), 1U);

  format.add_message(9, 5, "a");
  EXPECT_NE(read_db3(format.bytes(), {.topics = {"/scan"}}).fault.find("topic that is not in the file"),
            std::string::npos);
  EXPECT_NE(read_db3("SQLite format 3").fault, "");
}

/// A bag whose table of messages is made by `columns`, with many messages.
std::string bag_with_messages(const std::string& columns, const std::string& count = "2000",
                              const std::string& then = "") {
  Db3Writer writer;
  writer.run("PRAGMA page_size=512");
  writer.run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, serialization_format)");
  writer.run("INSERT INTO topics VALUES(1, '/t', 'a/msg/B', 'cdr')");
  writer.run("CREATE TABLE messages(" + columns + ")");
  writer.run("WITH RECURSIVE n(i) AS (VALUES(1) UNION ALL SELECT i + 1 FROM n WHERE i < " + count +
             ") INSERT INTO messages(topic_id, timestamp) SELECT 1, i FROM n");
  writer.run(then);
  return writer.bytes();
}

TEST(Db3Reader, OnlyStoredColumnsAreReadByTheNumbersOfRows) {
  EXPECT_EQ(read_db3(bag_with_messages("topic_id, timestamp, data")).messages.size(), 2000U);
  for (const char* name : {"rowid TEXT", "ROWID INTEGER"}) {
    const auto log = read_db3(bag_with_messages(std::string(name) + ", topic_id, timestamp, data"));
    EXPECT_NE(log.fault.find("'messages' has a column 'rowid'"), std::string::npos) << log.fault;
  }
  for (const char* name : {"topic_id, timestamp, data AS (zeroblob(200000000))",
                           "topic_id, timestamp, data BLOB AS (zeroblob(200000000)) STORED"}) {
    const auto log = read_db3(bag_with_messages(name, "1"));
    EXPECT_NE(log.fault.find("no stored column 'data'"), std::string::npos) << log.fault;
  }
}

TEST(Db3Reader, RowsThatShareTheirDataEndWithTheSizeOfTheFile) {
  const std::string shared = "data DEFAULT '" + std::string(50000, 'a') + "'";  // rows that lack it have it
  const auto log =
      read_db3(bag_with_messages("topic_id, timestamp", "2000", "ALTER TABLE messages ADD COLUMN " + shared));
  EXPECT_NE(log.fault.find("shares its bytes with others"), std::string::npos) << log.fault;
}

std::string big_endian(std::size_t value, std::size_t length) {
  std::string bytes;
  for (std::size_t i = length; i-- > 0;) bytes += static_cast<char>(value >> (8 * i) & 0xffU);
  return bytes;
}

/// Puts a tree of pages of 512 bytes where the table of messages is: on each level a page has the same child
/// 50 times, down to the leaf (sqlite.org/fileformat2.html, 1.6).
std::string with_pages_that_repeat(std::string bag, std::size_t levels) {
  constexpr std::size_t page = 512, width = 50, entry = 5;
  const std::size_t root = 2 * page;  // the table of topics has the second page
  const std::size_t first = bag.size() / page + 1;
  const auto inner = [&](std::size_t child) {
    const std::size_t start = page - width * entry;
    std::string bytes = big_endian(5, 1) + big_endian(0, 2) + big_endian(width, 2) + big_endian(start, 2) +
                        big_endian(0, 1) + big_endian(child, 4);
    for (std::size_t i = 0; i < width; ++i) bytes += big_endian(start + i * entry, 2);
    bytes.resize(start);
    for (std::size_t i = 0; i < width; ++i) bytes += big_endian(child, 4) + big_endian(i, 1);
    return bytes;
  };
  bag.replace(root, page, inner(first));
  for (std::size_t level = 1; level < levels; ++level) bag += inner(first + level);
  const std::string row("\x05\x01\x05\x00\x09\x08\x0c", 7);  // no id, topic 1, time 0, no data
  std::string leaf = big_endian(13, 1) + big_endian(0, 2) + big_endian(1, 2) +
                     big_endian(page - row.size(), 2) + big_endian(0, 1) + big_endian(page - row.size(), 2);
  leaf.resize(page - row.size());
  bag += leaf + row;
  return bag.replace(28, 4, big_endian(bag.size() / page, 4));
}

TEST(Db3Reader, PagesThatRepeatEndWithTheSizeOfTheFile) {
  const std::string bag = bag_with_messages("id INTEGER PRIMARY KEY, topic_id, timestamp, data", "1");
  const auto small = read_db3(with_pages_that_repeat(bag, 1));
  EXPECT_EQ(small.fault, "");
  EXPECT_EQ(small.messages.size(), 51U) << "the forged pages are read";
  const auto large = read_db3(with_pages_that_repeat(bag, 8));
  EXPECT_NE(large.fault.find("more work than a database of its size can need"), std::string::npos)
      << large.fault;
}

TEST(Db3Reader, ACutDatabaseIsRefusedAndSaysHowLongItWas) {
  const std::string bytes = RandomDb3(3, 20, true).bytes;
  for (std::size_t length = 0; length < bytes.size(); length += 97) {
    EXPECT_NE(read_db3(bytes.substr(0, length)).fault, "") << length;
  }
  EXPECT_NE(read_db3(bytes.substr(0, 5000)).fault.find("its end is missing"), std::string::npos);
}

TEST(Db3Reader, AFlippedBitIsNoCrashAndNoDisorder) {
  Rng rng(11);
  const RandomDb3 bag(4, 30, true);
  for (int i = 0; i < 3000; ++i) {
    std::string flipped = bag.bytes;
    const std::size_t most = i % 2 == 0 ? 4096 : flipped.size();
    const auto at = static_cast<std::size_t>(rng.uniform(0, static_cast<double>(most)));
    flipped[at] = static_cast<char>(rng.uniform(-128, 127));
    const ReadLog log = read_db3(flipped);
    EXPECT_TRUE(std::is_sorted(log.messages.begin(), log.messages.end(),
                               [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; }));
  }
}

}  // namespace
}  // namespace outrider
