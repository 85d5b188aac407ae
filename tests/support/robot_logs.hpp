// The messages of a robot, written as a log of each format.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bag_writer.hpp"
#include "db3_writer.hpp"
#include "outrider/log/encoding/codecs.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/mcap/mcap_writer.hpp"

namespace outrider::test {

/// Messages in the order of time.
class RobotMessages {
 public:
  template <class Message>
  void add(const std::string& topic, double time_s, const Message& message) {
    if (!numbers_.contains(topic)) {
      numbers_.emplace(topic, channels_.size());
      channels_.push_back(channel_of<Message>(topic));
    }
    messages_.push_back({numbers_.at(topic), nanoseconds(time_s),
                         [message](MessageEncoding encoding) { return encode(encoding, message); }});
  }

  [[nodiscard]] std::string mcap(MessageEncoding encoding = MessageEncoding::cdr) const {
    std::string bytes;
    auto writer = McapWriter::begin(make_string_sink(bytes), {.chunk_bytes = 20000});
    for (Channel channel : channels_) {
      if (encoding != MessageEncoding::cdr) {
        channel.schema.clear();
        channel.schema_encoding.clear();
        channel.encoding = encoding == MessageEncoding::ros1 ? "ros1" : "json";
        channel.schema = encoding == MessageEncoding::json ? "{}" : "";
        channel.schema_encoding = encoding == MessageEncoding::json ? "jsonschema" : "ros1msg";
      }
      static_cast<void>(writer->add_channel(channel));
    }
    for (const auto& [channel, time_ns, encoded] : messages_) {
      static_cast<void>(writer->write(channel, time_ns, encoded(encoding)));
    }
    static_cast<void>(writer->finish());
    return bytes;
  }

  [[nodiscard]] std::string bag(const std::string& compression = "none") const {
    BagWriter writer;
    writer.compression = compression;
    for (const Channel& channel : channels_) {
      std::string type = channel.type;
      writer.add_connection(channel.topic, type.erase(type.find("/msg/"), 4), "");
    }
    std::vector<BagMessage> chunk;
    for (const auto& [channel, time_ns, encoded] : messages_) {
      chunk.push_back({static_cast<std::uint32_t>(channel), time_ns, encoded(MessageEncoding::ros1)});
      if (chunk.size() == 20) writer.add_chunk(std::exchange(chunk, {}));
    }
    if (!chunk.empty()) writer.add_chunk(chunk);
    return writer.bytes();
  }

  [[nodiscard]] std::string db3() const {
    Db3Writer writer;
    writer.make_tables(false);
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      writer.add_topic(static_cast<int>(i) + 1, channels_[i].topic, channels_[i].type, false);
    }
    writer.run("BEGIN");
    for (const auto& [channel, time_ns, encoded] : messages_) {
      writer.add_message(static_cast<std::int64_t>(channel) + 1, time_ns, encoded(MessageEncoding::cdr));
    }
    writer.run("COMMIT");
    return writer.bytes();
  }

 private:
  struct Message {
    std::size_t channel = 0;
    std::int64_t time_ns = 0;
    std::function<std::string(MessageEncoding)> encoded;
  };

  std::vector<Channel> channels_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<Message> messages_;
};

}  // namespace outrider::test
