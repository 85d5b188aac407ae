// Logs for tests: random messages, written to memory and to files, and read back whole.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mcap/read/mcap_reader.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/log/mcap/mcap_writer.hpp"
#include "support/data.hpp"
#include "support/read_log.hpp"

namespace outrider::testing {

using test::read_all;
using test::ReadLog;
using OwnMessage = test::ReadMessage;
using OwnMessages = std::vector<OwnMessage>;

/// The ways to store a chunk.
constexpr Codec compressions[] = {Codec::none, Codec::lz4, Codec::zstd};

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

inline ReadLog read_all(const std::string& bytes, const LogSelection& selection = {}) {
  return read_all(open_mcap(memory_source(bytes, "run.mcap"), selection));
}

/// The messages in the order in which a reader gives them.
inline OwnMessages in_order(OwnMessages messages) {
  std::stable_sort(messages.begin(), messages.end(),
                   [](const OwnMessage& a, const OwnMessage& b) { return a.time_ns < b.time_ns; });
  return messages;
}

}  // namespace outrider::testing
