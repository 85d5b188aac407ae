// LogFeed: the messages of chosen channels of a log that grows, each channel from the beginning of the log.
//
// One reader goes ahead and finds the channels. A channel that is subscribed later is read from the beginning
// by a second reader, until that one has caught up. Channels that are subscribed in the meantime wait for it,
// so there are never more than two. Thread rule: one feed, one thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "outrider/log/mcap/mcap_follower.hpp"

namespace outrider::server {

class LogFeed {
 public:
  /// Reads the log in this file, which must exist.
  explicit LogFeed(const std::string& path) : path_(path), front_{McapFollower(path), {}} {}

  /// Returns the channels that were found so far, in the order of the log.
  [[nodiscard]] const std::vector<Channel>& channels() const { return front_.log.channels(); }
  /// Sends all messages of a channel, those that were and those that come.
  void subscribe(std::size_t channel) { waiting_.insert(channel); }
  void unsubscribe(std::size_t channel);

  /// Returns the size of the part of the log that is read next, in bytes; 0 if there is none by now. Fault:
  /// bad_input if the log cannot be read.
  Outcome<std::uint64_t> next();
  /// Reads that part and passes on its messages of subscribed channels. Fault: bad_input if the part is
  /// damaged.
  Status read(const std::function<void(const LogMessage&)>& on_message);

 private:
  struct Reader {
    McapFollower log;
    std::set<std::size_t> channels;
  };

  std::string path_;
  Reader front_;
  std::optional<Reader> behind_;
  std::set<std::size_t> waiting_;
};

}  // namespace outrider::server
