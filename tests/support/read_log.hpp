// Reads a log to its end, for comparison.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/log/log_reader.hpp"

namespace outrider::test {

struct ReadMessage {
  std::string topic;
  std::int64_t time_ns = 0;
  std::string data;

  friend bool operator==(const ReadMessage&, const ReadMessage&) = default;
};

struct ReadLog {
  std::vector<ReadMessage> messages;
  std::vector<Channel> channels;
  std::string fault;  ///< why it could not be read, or no further
  std::string cut_short;
};

inline ReadLog read_all(const Outcome<std::unique_ptr<LogReader>>& reader) {
  ReadLog log;
  if (!reader) {
    log.fault = to_string(reader.error());
    return log;
  }
  log.channels = (*reader)->channels();
  while (true) {
    auto message = (*reader)->next();
    if (!message) {
      log.fault = to_string(message.error());
      break;
    }
    if (!*message) break;
    log.messages.push_back({(*reader)->channels().at((*message)->channel).topic, (*message)->time_ns,
                            std::string((*message)->data)});
  }
  log.cut_short = (*reader)->cut_short();
  return log;
}

/// Returns the messages that a selection leaves.
inline std::vector<ReadMessage> filter(const std::vector<ReadMessage>& all, const LogSelection& selection) {
  std::vector<ReadMessage> left;
  for (const ReadMessage& message : all) {
    bool wanted = selection.topics.empty();
    for (const std::string& topic : selection.topics) wanted = wanted || topic == message.topic;
    if (message.time_ns < selection.from_ns || message.time_ns > selection.to_ns) wanted = false;
    if (wanted) left.push_back(message);
  }
  return left;
}

}  // namespace outrider::test
