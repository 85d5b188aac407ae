#include "outrider/log/read_log.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "outrider/log/append.hpp"
#include "outrider/log/mcap/mcap_writer.hpp"
#include "outrider/log/topics.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

using ChannelChange = std::function<void(Channel&)>;

/// Writes a log with changed channels.
class ChangingSink final : public LogSink {
 public:
  ChangingSink(McapWriter begun, ChannelChange change)
      : writer(std::move(begun)), change_(std::move(change)) {}
  void add_channel(const Channel& channel) override {
    Channel other = channel;
    if (change_) change_(other);
    writer.add_channel(other);
  }
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override {
    EXPECT_TRUE(writer.write(channel, time_ns, data));
  }

  McapWriter writer;

 private:
  ChannelChange change_;
};

std::string written(const test::Folder& folder, Log& log, ChannelChange change = {}) {
  std::string bytes;
  ChangingSink sink(McapWriter::begin(make_string_sink(bytes)).value(), std::move(change));
  log.add_sink(sink);
  log.remove_sink(sink);
  EXPECT_TRUE(sink.writer.finish());
  return folder.write("run.mcap", bytes);
}

Log run() {
  Log log;
  log_pose(log, 0.5, {{1.0, 2.0}, 0.5});
  log_event(log, 0.75, "shot", "shoots");
  log_pose(log, 1.25, {{3.0, 4.0}, 0.0});
  return log;
}

TEST(ReadLog, ReadsBackEveryMessage) {
  const test::Folder folder;
  Log log = run();
  const auto stored = read_log(written(folder, log));
  ASSERT_TRUE(stored) << to_string(stored.error());
  EXPECT_EQ(stored->cut_short, "");
  EXPECT_EQ(stored->log.channels().size(), log.channels().size());
  const auto& poses = stored->log.messages<geometry_msgs::PoseStamped>(topic::pose);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1].time_ns, 1'250'000'000);
  EXPECT_EQ(poses[1].message.pose.position.y, 4.0);
  EXPECT_EQ(events_of(stored->log).size(), 1U);
}

TEST(ReadLog, ASchemaThatLiesIsRefused) {
  const test::Folder folder;
  Log log = run();
  const auto stored = read_log(written(folder, log, [](Channel& channel) {
    const std::size_t at = channel.schema.find("string msg");
    if (at != std::string::npos) channel.schema.replace(at, 10, "string mug");
  }));
  ASSERT_FALSE(stored);
  EXPECT_EQ(stored.error().code, FaultCode::bad_input);
  for (const char* word : {"run.mcap", "/rosout", "mug"}) {
    EXPECT_NE(to_string(stored.error()).find(word), std::string::npos) << to_string(stored.error());
  }
}

TEST(ReadLog, ATypeThatARunNeverHasIsLeftOut) {
  const test::Folder folder;
  Log log = run();
  const auto stored = read_log(written(folder, log, [](Channel& channel) {
    if (channel.topic == topic::events) channel.type = "strange_msgs/msg/Thing";
  }));
  ASSERT_TRUE(stored) << to_string(stored.error());
  EXPECT_TRUE(events_of(stored->log).empty());
  EXPECT_EQ(stored->log.messages<geometry_msgs::PoseStamped>(topic::pose).size(), 2U);
}

TEST(ReadLog, ATopicWithTwoTypesIsRefused) {
  const test::Folder folder;
  Log log = run();
  const auto stored = read_log(written(folder, log, [](Channel& channel) { channel.topic = "/all"; }));
  ASSERT_FALSE(stored);
  EXPECT_NE(stored.error().sentence.find("two types"), std::string::npos) << to_string(stored.error());
}

TEST(ReadLog, WhatIsNoLogIsRefused) {
  const test::Folder folder;
  const auto stored = read_log(folder.write("text", "this is no log at all"));
  ASSERT_FALSE(stored);
  EXPECT_EQ(stored.error().code, FaultCode::bad_input);
}

}  // namespace
}  // namespace outrider
