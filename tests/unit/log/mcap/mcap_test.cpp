// MCAP files that are whole: what is written is read.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <sys/resource.h>

#include "mcap_logs.hpp"
#include "outrider/log/mcap/mcap_file.hpp"

namespace outrider::testing {
namespace {

TEST(Mcap, WhatIsWrittenIsRead) {
  Rng rng(1);
  for (const Codec compression : testing::compressions) {
    for (const std::size_t chunk_bytes : {1U, 200U, 5000U, 1U << 20U}) {
      const OwnMessages messages = random_messages(rng, 300);
      const ReadLog read =
          read_all(mcap_of(messages, {.compression = compression, .chunk_bytes = chunk_bytes}));
      EXPECT_EQ(read.fault, "");
      EXPECT_EQ(read.cut_short, "");
      EXPECT_EQ(read.messages, in_order(messages));
    }
  }
}

TEST(Mcap, OverlappingChunksAreReadInOrder) {
  Rng rng(2);
  for (const std::uint64_t jitter_ns : {20U, 300U, 100000U}) {
    const OwnMessages messages = random_messages(rng, 500, jitter_ns);
    const ReadLog read = read_all(mcap_of(messages, {.chunk_bytes = 300}));
    EXPECT_EQ(read.fault, "");
    EXPECT_EQ(read.messages, in_order(messages));
  }
}

TEST(Mcap, AnyMessagesComeBack) {
  EXPECT_TRUE(rc::check(
      [](const std::vector<std::pair<std::uint32_t, std::string>>& made, std::uint16_t chunk_bytes) {
        OwnMessages messages;
        for (const auto& [time, data] : made) {
          messages.push_back({"/t" + std::to_string(data.size() % 3), std::int64_t{time}, data});
        }
        const ReadLog read = read_all(mcap_of(messages, {.chunk_bytes = chunk_bytes}));
        RC_ASSERT(read.fault.empty());
        RC_ASSERT(read.messages == in_order(messages));
      }));
}

TEST(Mcap, ASelectionIsAFilterOfEverything) {
  Rng rng(3);
  const OwnMessages all = random_messages(rng, 400, 200);
  const std::string bytes = mcap_of(all, {.chunk_bytes = 400});
  for (int i = 0; i < 200; ++i) {
    LogSelection selection;
    for (const char* topic : {"/a", "/b", "/c", "/none"}) {
      if (rng.below(2) == 0) selection.topics.emplace_back(topic);
    }
    if (rng.below(4) > 0) selection.from_ns = static_cast<std::int64_t>(rng.below(2400)) - 100;
    if (rng.below(4) > 0) selection.to_ns = static_cast<std::int64_t>(rng.below(2400)) - 100;
    const OwnMessages expected = test::filter(in_order(all), selection);
    const ReadLog read = read_all(bytes, selection);
    EXPECT_EQ(read.fault, "");
    EXPECT_EQ(read.messages, expected);
    EXPECT_EQ(read.channels.size(), 4U);
  }
}

/// Counts the bytes that are read from a file in memory.
class CountingSource final : public ByteSource {
 public:
  CountingSource(const std::string& bytes, std::uint64_t& count)
      : ByteSource("run.mcap", bytes.size()), bytes_(bytes), count_(count) {}

 private:
  [[nodiscard]] Status read_into(std::uint64_t offset, std::string& bytes) const override {
    bytes_.copy(bytes.data(), bytes.size(), offset);
    count_ += bytes.size();
    return {};
  }

  const std::string& bytes_;
  std::uint64_t& count_;
};

TEST(Mcap, ASelectionReadsAFewChunksOnly) {
  OwnMessages messages;
  for (std::int64_t i = 0; i < 200; ++i) {
    messages.push_back({i == 77 ? "/rare" : "/often", i, std::string(100000, static_cast<char>(i))});
  }
  const std::string bytes = mcap_of(messages, {.compression = Codec::none});
  for (const LogSelection& selection : {LogSelection{{"/rare"}}, LogSelection{{}, 77, 77}}) {
    std::uint64_t count = 0;
    const ReadLog read = read_all(open_mcap(std::make_unique<CountingSource>(bytes, count), selection));
    ASSERT_EQ(read.messages.size(), 1U);
    EXPECT_EQ(read.messages[0], messages[77]);
    EXPECT_LT(count, bytes.size() / 8);
  }
}

/// The most memory that this process has had.
long peak_kib() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(Mcap, ALongLogNeedsLittleMemory) {
  std::string bytes;
  auto writer = McapWriter::begin(make_string_sink(bytes));
  const std::size_t channel = writer->add_channel(channel_named("/a"));
  for (std::int64_t i = 0; i < 3000; ++i) EXPECT_TRUE(writer->write(channel, i, std::string(200000, 'x')));
  EXPECT_TRUE(writer->finish());
  EXPECT_LT(bytes.size(), 1000000U);
  const long before_kib = peak_kib();
  const auto log = open_mcap(memory_source(bytes, "run.mcap"), {});
  std::size_t count = 0;
  for (auto message = (*log)->next(); message && *message; message = (*log)->next()) ++count;
  EXPECT_EQ(count, 3000U);  // of 600 MB together
  EXPECT_LT(peak_kib() - before_kib, 200L * 1024);
}

TEST(Mcap, ChannelsComeBackWholeAndSchemasAreStoredOnce) {
  const std::vector<Channel> channels = {channel_named("/a"),
                                         channel_named("/b"),
                                         channel_named("/b", "x/msg/Y"),
                                         {"/json", "", "json", "", ""}};
  std::string bytes;
  auto writer = McapWriter::begin(make_string_sink(bytes), {.compression = Codec::none});
  for (const Channel& channel : channels) writer->add_channel(channel);
  EXPECT_TRUE(writer->write(2, 5, "data"));
  EXPECT_TRUE(writer->finish());
  EXPECT_EQ(read_all(bytes).channels, channels);
  std::size_t stored = 0;
  for (std::size_t at = 0; (at = bytes.find("std_msgs/msg/String", at)) != std::string::npos; ++at) ++stored;
  EXPECT_EQ(stored, 2U);  // in the data, and in the summary
}

TEST(Mcap, SameCallsSameBytes) {
  Rng rng(4);
  const OwnMessages messages = random_messages(rng, 300, 50);
  for (const Codec compression : testing::compressions) {
    const McapOptions options{.compression = compression, .chunk_bytes = 1000};
    EXPECT_EQ(mcap_of(messages, options), mcap_of(messages, options));
  }
}

TEST(Mcap, AFileHoldsAttachmentsAndMetadata) {
  const test::Folder folder;
  const std::string path = (folder.path / "run.mcap").string();
  auto writer = McapWriter::create(path);
  ASSERT_TRUE(writer);
  const std::size_t channel = writer->add_channel(channel_named("/a"));
  EXPECT_TRUE(writer->attach("scenario.yaml", "text/yaml", "job: drive\n", 3));
  EXPECT_TRUE(writer->write(channel, 7, "hello"));
  EXPECT_TRUE(writer->add_metadata("run", {{"seed", "1"}}));
  EXPECT_TRUE(writer->flush());
  EXPECT_TRUE(writer->attach("run.json", "application/json", std::string(100000, '{')));
  EXPECT_TRUE(writer->finish());
  EXPECT_FALSE(writer->write(channel, 8, "late"));

  const auto attachments = read_attachments(path);
  ASSERT_TRUE(attachments);
  ASSERT_EQ(attachments->size(), 2U);
  EXPECT_EQ((*attachments)[0], (LogAttachment{"scenario.yaml", "text/yaml", "job: drive\n", 3}));
  EXPECT_EQ((*attachments)[1].content.size(), 100000U);
  const ReadLog read = read_all(open_log(path));
  EXPECT_EQ(read.messages, (OwnMessages{{"/a", 7, "hello"}}));
}

TEST(Mcap, AnEmptyLogIsALog) {
  const ReadLog read = read_all(mcap_of({}));
  EXPECT_EQ(read.fault, "");
  EXPECT_EQ(read.cut_short, "");
  EXPECT_TRUE(read.messages.empty());
}

TEST(Mcap, WhatCannotBeWrittenIsRefused) {
  std::string bytes;
  auto writer = McapWriter::begin(make_string_sink(bytes));
  EXPECT_EQ(writer->write(0, 1, "x").error().code, FaultCode::bad_input);
  writer->add_channel(channel_named("/a"));
  EXPECT_EQ(writer->write(0, -1, "x").error().code, FaultCode::bad_input);
  EXPECT_TRUE(writer->write(0, 1, "x"));
  EXPECT_TRUE(writer->finish());
  EXPECT_EQ(read_all(bytes).messages.size(), 1U);
}

TEST(Mcap, AFullDiskIsSaidWithThePath) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  const auto writer = McapWriter::create("/dev/full");
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, FaultCode::cannot_write);
  EXPECT_EQ(writer.error().where, "/dev/full");
  EXPECT_EQ(McapWriter::create("no/such/folder/run.mcap").error().code, FaultCode::cannot_write);
}

}  // namespace
}  // namespace outrider::testing
