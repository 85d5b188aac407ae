// Logs for tests: random messages, written to memory and to files, and read back whole.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "mcap_reader.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/log/mcap_writer.hpp"

namespace outrider::testing {

/// A message that owns its data; the topic stands for the channel.
struct OwnMessage {
  std::string topic;
  std::int64_t time_ns = 0;
  std::string data;

  friend bool operator==(const OwnMessage&, const OwnMessage&) = default;
};

using OwnMessages = std::vector<OwnMessage>;

inline Channel channel_named(const std::string& topic, const std::string& type = "std_msgs/msg/String") {
  return {topic, type, "cdr", "ros2msg", "string data\n", {{"qos", "reliable"}}};
}

/// Messages whose times wander back and forth by up to `jitter_ns`.
inline OwnMessages random_messages(Rng& rng, std::size_t count, std::uint64_t jitter_ns = 0) {
  OwnMessages messages;
  for (std::size_t i = 0; i < count; ++i) {
    OwnMessage message{std::string("/") + static_cast<char>('a' + rng.below(4)), 0, {}};
    message.time_ns = static_cast<std::int64_t>(10 * (i / 2) + (jitter_ns > 0 ? rng.below(jitter_ns) : 0));
    message.data.resize(rng.below(60));
    for (char& c : message.data) c = static_cast<char>(rng.below(rng.below(2) == 0 ? 256 : 3));
    messages.push_back(message);
  }
  return messages;
}

/// Writes the messages, a channel for each topic when it first comes; a chunk takes `chunk_bytes`.
inline void write_messages(McapWriter& writer, const OwnMessages& messages) {
  std::vector<std::string> topics;
  for (const OwnMessage& message : messages) {
    const auto found = std::find(topics.begin(), topics.end(), message.topic);
    const auto channel = static_cast<std::size_t>(found - topics.begin());
    if (found == topics.end()) {
      topics.push_back(message.topic);
      ASSERT_EQ(writer.add_channel(channel_named(message.topic)), channel);
    }
    const Status written = writer.write(channel, message.time_ns, message.data);
    ASSERT_TRUE(written) << to_string(written.error());
  }
}

inline std::string mcap_of(const OwnMessages& messages, const McapOptions& options = {}) {
  std::string bytes;
  auto writer = McapWriter::begin(make_string_sink(bytes), options);
  write_messages(*writer, messages);
  EXPECT_TRUE(writer->finish());
  return bytes;
}

/// What a log gave until its end or its first fault.
struct ReadLog {
  OwnMessages messages;
  std::vector<Channel> channels;
  std::string cut_short;
  std::string fault;  ///< empty: none
};

inline ReadLog read_all(LogOpened log) {
  ReadLog read;
  if (!log) {
    read.fault = to_string(log.error());
    return read;
  }
  read.channels = (*log)->channels();
  read.cut_short = (*log)->cut_short();
  while (true) {
    const auto message = (*log)->next();
    if (!message) read.fault = to_string(message.error());
    if (!message || !*message) return read;
    const LogMessage& m = **message;
    read.messages.push_back({read.channels.at(m.channel).topic, m.time_ns, std::string(m.data)});
  }
}

inline ReadLog read_all(const std::string& bytes, const LogSelection& selection = {}) {
  return read_all(open_mcap(memory_source(bytes, "run.mcap"), selection));
}

/// The messages in the order in which a reader gives them.
inline OwnMessages in_order(OwnMessages messages) {
  std::stable_sort(messages.begin(), messages.end(),
                   [](const OwnMessage& a, const OwnMessage& b) { return a.time_ns < b.time_ns; });
  return messages;
}

/// A folder of its own for a test, removed with the object.
class LogFolder {
 public:
  LogFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("outrider-") + test->name() + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  ~LogFolder() { std::filesystem::remove_all(path_); }
  LogFolder(const LogFolder&) = delete;
  LogFolder& operator=(const LogFolder&) = delete;

  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace outrider::testing
