// MCAP files that are cut, damaged, or made to harm; and those that others write differently.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>

#include "bytes/compression.hpp"
#include "mcap/mcap_attachments.hpp"
#include "mcap/mcap_encode.hpp"
#include "mcap_logs.hpp"

namespace outrider::testing {
namespace {

/// A header, then whatever the test appends.
std::string beginning() {
  std::string bytes(mcap::magic);
  mcap::append_header(bytes, "ros2", "test");
  mcap::append_channel(bytes, {1, 0, "/a", "cdr"});
  return bytes;
}

std::string message_bytes(std::uint64_t time, std::string_view data, std::uint16_t channel_id = 1) {
  std::string bytes;
  mcap::append_message(bytes, {channel_id, 1, time, time, data});
  return bytes;
}

/// Ends a file without a summary.
std::string ended(std::string bytes) {
  mcap::append_data_end(bytes, mcap::crc32_of(bytes));
  mcap::append_footer(bytes, {});
  return bytes.append(mcap::magic);
}

std::string chunk_bytes(mcap::ChunkRecord chunk) {
  std::string bytes = beginning();
  mcap::append_chunk(bytes, chunk);
  return ended(bytes);
}

/// The file with its records of messages, chunks and so on, but without what follows the data.
std::string without_summary(const std::string& bytes) {
  std::string all = bytes;
  std::uint64_t start = 0;
  const std::size_t footer = bytes.size() - mcap::tail_bytes + mcap::head_bytes;
  for (std::size_t i = 8; i-- > 0;) start = (start << 8U) | static_cast<unsigned char>(bytes[footer + i]);
  all.resize(start);
  return all;
}

TEST(McapDamage, ACutLogOpensUpToItsLastCompleteChunk) {
  Rng rng(1);
  const OwnMessages messages = random_messages(rng, 60);
  for (const Codec compression : testing::compressions) {
    const std::string bytes = mcap_of(messages, {.compression = compression, .chunk_bytes = 300});
    std::size_t before = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const ReadLog read = read_all(bytes.substr(0, length));
      EXPECT_EQ(read.fault.empty(), length >= mcap::magic.size()) << length << read.fault;
      if (!read.fault.empty()) continue;
      EXPECT_FALSE(read.cut_short.empty()) << length;
      ASSERT_LE(read.messages.size(), messages.size());
      EXPECT_TRUE(std::equal(read.messages.begin(), read.messages.end(), messages.begin())) << length;
      EXPECT_GE(read.messages.size(), before);
      before = read.messages.size();
    }
    EXPECT_EQ(before, messages.size());
  }
}

TEST(McapDamage, WhatWasFlushedIsReadWhenTheRestIsMissing) {
  const test::Folder folder;
  const std::string path = (folder.path / "run.mcap").string();
  auto writer = McapWriter::create(path);
  const std::size_t channel = writer->add_channel(channel_named("/a"));
  EXPECT_TRUE(writer->write(channel, 1, "one"));
  EXPECT_TRUE(writer->flush());
  EXPECT_TRUE(writer->write(channel, 2, "two"));  // it is still in memory, as when a process is killed
  const ReadLog read = read_all(open_log(path));
  EXPECT_EQ(read.messages, (OwnMessages{{"/a", 1, "one"}}));
  EXPECT_NE(read.cut_short.find("the log ends early"), std::string::npos);
}

TEST(McapDamage, AKilledProcessLeavesALog) {
  const test::Folder folder;
  const std::string path = (folder.path / "run.mcap").string();
  const pid_t child = ::fork();
  if (child == 0) {
    auto writer = McapWriter::create(path, {.chunk_bytes = 100});
    const std::size_t channel = writer->add_channel(channel_named("/a"));
    for (std::int64_t i = 0; i < 1000; ++i) static_cast<void>(writer->write(channel, i, "0123456789"));
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  const ReadLog read = read_all(open_log(path));
  EXPECT_EQ(read.fault, "");
  EXPECT_GT(read.messages.size(), 990U);
  EXPECT_FALSE(read.cut_short.empty());
}

/// Takes so many bytes, then fails as a full disk does.
class FullSink final : public ByteSink {
 public:
  FullSink(std::string& bytes, std::size_t room) : bytes_(bytes), room_(room) {}
  Status write(std::string_view more) override {
    bytes_.append(more.substr(0, room_ - bytes_.size()));
    if (bytes_.size() < room_) return {};
    return fault(FaultCode::cannot_write, "the disk is full", "run.mcap");
  }

 private:
  std::string& bytes_;
  std::size_t room_;
};

TEST(McapDamage, AfterAFullDiskEveryCallIsRefusedAndTheLogOpens) {
  for (std::size_t room = 100; room < 3000; room += 37) {
    std::string bytes;
    auto writer = McapWriter::begin(std::make_unique<FullSink>(bytes, room), {.chunk_bytes = 200});
    ASSERT_TRUE(writer);
    const std::size_t channel = writer->add_channel(channel_named("/a"));
    Status written;
    for (std::int64_t i = 0; i < 500 && written; ++i) written = writer->write(channel, i, "0123456789");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, FaultCode::cannot_write);
    EXPECT_EQ(writer->flush().error().where, "run.mcap");
    EXPECT_EQ(writer->attach("a", "b", "c").error().where, "run.mcap");
    EXPECT_EQ(writer->finish().error().where, "run.mcap");
    EXPECT_EQ(bytes.size(), room);
    EXPECT_EQ(read_all(bytes).fault, "");
  }
}

TEST(McapDamage, AFlippedBitIsNoticedOrHarmless) {
  Rng rng(2);
  const OwnMessages messages = random_messages(rng, 30, 30);
  for (const Codec compression : testing::compressions) {
    const std::string whole = mcap_of(messages, {.compression = compression, .chunk_bytes = 400});
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      std::string bytes = whole;
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
      const ReadLog read = read_all(bytes);
      if (read.fault.empty()) {
        EXPECT_EQ(read.messages, in_order(messages)) << bit;
      }
    }
  }
}

TEST(McapDamage, AFlippedBitInACutLogGivesNoWrongMessage) {
  Rng rng(3);
  const OwnMessages messages = random_messages(rng, 30);
  const std::string whole = without_summary(mcap_of(messages, {.chunk_bytes = 400}));
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    const ReadLog read = read_all(bytes);
    if (!read.fault.empty()) continue;
    ASSERT_LE(read.messages.size(), messages.size()) << bit;
    EXPECT_TRUE(std::equal(read.messages.begin(), read.messages.end(), messages.begin())) << bit;
    EXPECT_FALSE(read.cut_short.empty());
  }
}

TEST(McapDamage, ABombIsRefused) {
  const std::string zeros(50U << 20U, '\0');
  for (const Codec compression : {Codec::lz4, Codec::zstd}) {
    const std::string honest = mcap_of({{"/a", 1, zeros}}, {.compression = compression});
    EXPECT_LT(honest.size(), 300000U);
    EXPECT_EQ(read_all(honest).fault, "");
  }
  const std::string lie(100, 'x');
  EXPECT_NE(read_all(chunk_bytes({0, 1, std::uint64_t{1} << 60U, 0, "zstd", lie})).fault.find("does not fit"),
            std::string::npos);
  EXPECT_NE(read_all(chunk_bytes({0, 1, 200U << 20U, 0, "zstd", lie})).fault.find("damaged"),
            std::string::npos);
  EXPECT_NE(read_all(chunk_bytes({0, 1, 99, 0, "", lie})).fault.find("not the stated"), std::string::npos);
  EXPECT_NE(read_all(chunk_bytes({0, 1, 100, 0, "bzip9\n", lie})).fault.find("\"bzip9?\" is unknown"),
            std::string::npos);
}

TEST(McapDamage, ATimeBeyond63BitsIsRefusedWhereverItStands) {
  const std::uint64_t late = std::uint64_t{1} << 63U;
  const std::string sentence = "lies after the year 2262";
  EXPECT_NE(read_all(ended(beginning() + message_bytes(late, "data"))).fault.find(sentence),
            std::string::npos);
  const std::string message = message_bytes(late, "data");
  EXPECT_NE(read_all(chunk_bytes({late, late, message.size(), 0, "", message})).fault.find(sentence),
            std::string::npos);
  std::string listed = beginning();
  const std::uint64_t at = listed.size();
  mcap::append_chunk(listed, {late, late, message.size(), 0, "", message});
  const std::uint64_t length = listed.size() - at;
  mcap::append_data_end(listed, 0);
  const std::uint64_t summary = listed.size();
  mcap::append_channel(listed, {1, 0, "/a", "cdr"});
  mcap::append_chunk_index(listed, {late, late, at, length});
  mcap::append_footer(listed,
                      {.summary_start = summary, .summary_crc = mcap::crc32_of(listed.substr(summary))});
  listed.append(mcap::magic);
  EXPECT_NE(read_all(listed).fault.find(sentence), std::string::npos) << read_all(listed).fault;
}

TEST(McapDamage, LiesOfAChunkAreRefused) {
  const std::string message = message_bytes(5, "data");
  const auto fault_of = [&](const mcap::ChunkRecord& chunk) { return read_all(chunk_bytes(chunk)).fault; };
  EXPECT_EQ(fault_of({5, 5, message.size(), 0, "", message}), "");
  EXPECT_EQ(fault_of({5, 5, message.size(), mcap::crc32_of(message), "", message}), "");
  EXPECT_NE(fault_of({5, 5, message.size(), 1, "", message}).find("checksum"), std::string::npos);
  EXPECT_NE(fault_of({6, 7, message.size(), 0, "", message}).find("outside of the times"), std::string::npos);
  const std::string stranger = message_bytes(5, "data", 2);
  EXPECT_NE(fault_of({5, 5, stranger.size(), 0, "", stranger}).find("channel 2"), std::string::npos);
  const std::string late = message_bytes(std::uint64_t{1} << 63U, "data");
  EXPECT_NE(fault_of({5, 5, late.size(), 0, "", late}).find("2262"), std::string::npos);
  std::string inner;
  mcap::append_chunk(inner, {5, 5, message.size(), 0, "", message});
  EXPECT_NE(fault_of({5, 5, inner.size(), 0, "", inner}).find("does not belong"), std::string::npos);
  std::string changed;
  mcap::append_channel(changed, {1, 0, "/b", "cdr"});
  EXPECT_NE(fault_of({5, 5, changed.size(), 0, "", changed}).find("differently"), std::string::npos);
}

TEST(McapDamage, ASummaryThatNamesAnotherChunkIsRefused) {
  const std::string message = message_bytes(5, "data");
  std::string data = beginning();
  const std::uint64_t chunk_offset = data.size();
  mcap::append_chunk(data, {5, 5, message.size(), 0, "", message});
  const std::uint64_t length = data.size() - chunk_offset;
  mcap::append_data_end(data, 0);
  const auto fault_of = [&](const std::vector<mcap::ChunkIndexRecord>& chunks) {
    std::string summary;
    mcap::append_channel(summary, {1, 0, "/a", "cdr"});
    for (const auto& chunk : chunks) mcap::append_chunk_index(summary, chunk);
    const mcap::FooterRecord footer{data.size(), 0, mcap::crc32_of(summary)};
    mcap::append_footer(summary, footer);
    return read_all(data + summary.append(mcap::magic)).fault;
  };
  const mcap::ChunkIndexRecord honest{5, 5, chunk_offset, length, {{1, 0}}};
  EXPECT_EQ(fault_of({honest}), "");
  EXPECT_EQ(fault_of({}), "");
  EXPECT_NE(fault_of({honest, honest}).find("twice"), std::string::npos);
  EXPECT_NE(fault_of({{4, 5, chunk_offset, length, {}}}).find("times"), std::string::npos);
  EXPECT_NE(fault_of({{6, 5, chunk_offset, length, {}}}).find("before it starts"), std::string::npos);
  EXPECT_NE(fault_of({{5, 5, chunk_offset, length - 1, {}}}).find("does not name"), std::string::npos);
  EXPECT_NE(fault_of({{5, 5, chunk_offset + 1, length, {}}}).find("does not name"), std::string::npos);
  EXPECT_NE(fault_of({{5, 5, 1U << 30U, length, {}}}).find("none can be"), std::string::npos);
  EXPECT_NE(fault_of({honest, {5, 5, 8, 20, {}}}).find("there is not the chunk"), std::string::npos);
  EXPECT_NE(fault_of({{5, 5, chunk_offset, length, {{2, 0}}}}).find("does not name"), std::string::npos);
}

TEST(McapDamage, TooMuchOverlapIsRefusedBeforeItIsLoaded) {
  std::string block = message_bytes(0, std::string(90U << 20U, '\0'));
  block += message_bytes(9, "end");
  const std::string packed = compress(Codec::zstd, block);
  std::string bytes = beginning();
  for (int i = 0; i < 6; ++i) mcap::append_chunk(bytes, {0, 9, block.size(), 0, "zstd", packed});
  EXPECT_NE(read_all(open_mcap(memory_source(bytes, "run.mcap"), {.from_ns = 9})).fault.find("does not fit"),
            std::string::npos);
}

TEST(McapDamage, ManyChannelsWithOneLongSchemaAreRefused) {
  std::string bytes(mcap::magic);
  mcap::append_header(bytes, "ros2", "test");
  mcap::append_schema(bytes, {1, "a/msg/B", "ros2msg", std::string(1U << 20U, '\n')});
  std::string log = bytes;
  for (std::uint16_t id = 1; id <= 30; ++id) mcap::append_channel(log, {id, 1, "/a", "cdr"});
  EXPECT_EQ(read_all(ended(log)).fault, "");
  for (std::uint16_t id = 31; id <= 33; ++id) mcap::append_channel(log, {id, 1, "/a", "cdr"});
  EXPECT_NE(read_all(ended(log)).fault.find("schemas of more than 33554432 bytes"), std::string::npos);
}

TEST(McapDamage, AChannelNeedsItsSchema) {
  std::string bytes = beginning();
  mcap::append_channel(bytes, {2, 9, "/b", "cdr"});
  EXPECT_NE(read_all(ended(bytes)).fault.find("schema 9"), std::string::npos);
}

TEST(McapOthers, MessagesOutsideOfChunksAreRead) {
  Rng rng(4);
  std::string bytes = beginning();
  OwnMessages messages = random_messages(rng, 200, 90);
  for (OwnMessage& message : messages) {
    message.topic = "/a";
    bytes += message_bytes(static_cast<std::uint64_t>(message.time_ns), message.data);
  }
  const std::string chunked = message_bytes(500, "in a chunk");
  mcap::append_chunk(bytes, {500, 500, chunked.size(), 0, "", chunked});
  messages.push_back({"/a", 500, "in a chunk"});
  EXPECT_EQ(read_all(ended(bytes)).messages, in_order(messages));
  EXPECT_EQ(read_all(bytes).messages, in_order(messages));  // the end is missing
}

TEST(McapOthers, UnknownRecordsAreSkipped) {
  std::string bytes = beginning();
  bytes.append("\x90\x03\0\0\0\0\0\0\0abc", 12);
  bytes += message_bytes(1, "data");
  EXPECT_EQ(read_all(ended(bytes)).messages.size(), 1U);
}

TEST(McapOthers, TheChecksumOfTheDataCoversMessagesOutsideOfChunks) {
  std::string bytes = ended(beginning() + message_bytes(1, "data"));
  bytes[bytes.find("data")] = 'D';
  EXPECT_NE(read_all(bytes).fault.find("checksum of the data"), std::string::npos);
}

TEST(McapOthers, ADamagedAttachmentIsRefused) {
  std::string bytes;
  auto writer = McapWriter::begin(make_string_sink(bytes));
  EXPECT_TRUE(writer->attach("run.json", "application/json", "{content}"));
  EXPECT_TRUE(writer->finish());
  EXPECT_EQ(read_attachments(*memory_source(bytes, "run.mcap"))->size(), 1U);
  bytes[bytes.find("{content}")] = '[';
  const auto damaged = read_attachments(*memory_source(bytes, "run.mcap"));
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().sentence.find("checksum"), std::string::npos);
}

}  // namespace
}  // namespace outrider::testing
