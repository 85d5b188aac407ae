// Log: the messages of a run, each on a named channel with its time. A log is only ever appended to.
//
//   Log log;
//   log.append("/pose", 1.5, pose_stamped);
//   for (const auto& [time_ns, shot] : log.messages<outrider_msgs::Shot>("/shots")) ...
//
// A channel holds messages of one type. Constant data are a message at time 0. A change is a newer message on
// the same channel: the latest message at or before a time holds at that time. The times of a channel never
// decrease; different channels may be appended to in any order.
//
// A sink receives each message, encoded, as it is appended: a file (McapSink), or somebody who watches the
// run. Messages are encoded only if there is a sink, and once for all sinks. Thread rule: one thread at a
// time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/log/encoding/codecs.hpp"
#include "outrider/log/encoding/message_type.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

/// Returns the time in nanoseconds, rounded. Expects a finite time below 9e9 s.
inline std::int64_t nanoseconds(double time_s) { return std::llround(time_s * 1e9); }

/// Returns the time in seconds: the double nearest to it, so that nanoseconds() gives the same time back, for
/// times up to 13 days. A longer time, such as one since 1970, is rounded to the next double or the one
/// after.
inline double seconds(std::int64_t time_ns) {
  constexpr std::int64_t exact_ns = std::int64_t{1} << 53, second_ns = 1'000'000'000;
  if (-exact_ns < time_ns && time_ns < exact_ns) return static_cast<double>(time_ns) / 1e9;
  return static_cast<double>(time_ns / second_ns) + static_cast<double>(time_ns % second_ns) / 1e9;
}

/// Returns the time in whole nanoseconds, as a message has it: one that was logged and read is the same.
inline double logged_time(double time_s) { return seconds(nanoseconds(time_s)); }

/// A message and its time.
template <class Message>
struct Stamped {
  std::int64_t time_ns = 0;
  Message message;
  [[nodiscard]] double time_s() const { return seconds(time_ns); }
};

class Log;

/// Receives the messages of a log as they are appended. A sink never changes a run: a sink that fails keeps
/// its fault to itself until it is asked.
class LogSink {
 public:
  virtual ~LogSink() = default;
  LogSink(const LogSink&) = delete;
  LogSink& operator=(const LogSink&) = delete;
  /// Called when the sink is added to a log, before anything else. The log must not be changed.
  virtual void begin(const Log& /*log*/) {}
  /// Receives a new channel. Channels are numbered 0, 1, 2, ... in this order.
  virtual void add_channel(const Channel& channel) = 0;
  /// Receives a message, CDR-encoded.
  virtual void append(std::size_t channel, std::int64_t time_ns, std::string_view data) = 0;

 protected:
  LogSink() = default;
};

class Log {
 public:
  Log() = default;
  Log(Log&&) noexcept = default;
  Log& operator=(Log&&) noexcept = default;

  /// Lets the times of all further messages count from `time_s`, for a mission that follows another one.
  void begin_at(double time_s) { origin_ns_ = nanoseconds(time_s); }

  /// Returns the time that a message has in the log, for its header.
  [[nodiscard]] double time_of(double time_s) const { return seconds(origin_ns_ + nanoseconds(time_s)); }

  /// Appends a message to the channel, which the first message makes. Expects the type of the earlier
  /// messages of the channel; a time before that of the newest one counts as that time.
  template <class Message>
  void append(std::string_view topic, double time_s, Message message) {
    append_at(topic, origin_ns_ + nanoseconds(time_s), std::move(message));
  }

  /// Returns the messages of a channel in the order of time; none if there is no such channel of this type.
  template <class Message>
  [[nodiscard]] const std::vector<Stamped<Message>>& messages(std::string_view topic) const;

  /// Returns the newest message of a channel; null if there is none.
  template <class Message>
  [[nodiscard]] const Message* latest(std::string_view topic) const {
    const auto& all = messages<Message>(topic);
    return all.empty() ? nullptr : &all.back().message;
  }

  /// Returns the channels in the order of their first messages.
  [[nodiscard]] const std::vector<Channel>& channels() const { return infos_; }
  /// Returns the time of the newest message of all channels, s; 0 if there is none.
  [[nodiscard]] double end_s() const { return seconds(end_ns_); }

  /// Keeps only the newest messages of each channel from now on, up to twice that many, for runs without end
  /// of which sinks receive everything. Expects 1 or more.
  void keep_newest(std::size_t messages) {
    kept_ = messages;
    order_.clear();
  }

  /// Sends everything so far to a sink in the order in which it was appended, then each new message. The sink
  /// must outlive the log or be removed. Of a log that keeps only the newest, a sink receives the channels
  /// and what comes from then on.
  void add_sink(LogSink& sink);
  void remove_sink(LogSink& sink) { std::erase(sinks_, &sink); }

 private:
  template <class Message>
  void append_at(std::string_view topic, std::int64_t time_ns, Message message);

  struct AnyChannel {
    explicit AnyChannel(const MessageType& of) : type(&of) {}
    virtual ~AnyChannel() = default;
    AnyChannel(const AnyChannel&) = delete;
    AnyChannel& operator=(const AnyChannel&) = delete;
    /// Returns the time and the address of a message.
    [[nodiscard]] virtual std::pair<std::int64_t, const void*> at(std::size_t index) const = 0;
    const MessageType* type;
  };
  template <class Message>
  struct TypedChannel final : AnyChannel {
    TypedChannel() : AnyChannel(message_type<Message>()) {}
    [[nodiscard]] std::pair<std::int64_t, const void*> at(std::size_t index) const override {
      return {messages[index].time_ns, &messages[index].message};
    }
    std::vector<Stamped<Message>> messages;
  };

  void note_channel(std::string_view topic, const Channel& info);
  void note_message(std::size_t channel, std::int64_t time_ns, const void* message);
  /// Returns how many of so many messages of a channel are too old to be kept.
  [[nodiscard]] std::size_t too_old(std::size_t messages) const {
    return kept_ && messages >= 2 * *kept_ ? messages - *kept_ : 0;
  }

  std::vector<std::unique_ptr<AnyChannel>> channels_;
  std::vector<Channel> infos_;
  std::map<std::string, std::size_t, std::less<>> numbers_;  ///< topic -> channel
  std::vector<std::uint32_t> order_;  ///< the channel of each message, unless only the newest are kept
  std::optional<std::size_t> kept_;   ///< messages of each channel; unset: all
  std::int64_t origin_ns_ = 0;
  std::int64_t end_ns_ = 0;
  std::vector<LogSink*> sinks_;
};

template <class Message>
void Log::append_at(std::string_view topic, std::int64_t time_ns, Message message) {
  auto found = numbers_.find(topic);
  if (found == numbers_.end()) {
    channels_.push_back(std::make_unique<TypedChannel<Message>>());
    note_channel(topic, channel_of<Message>(std::string(topic)));
    found = numbers_.find(topic);
  }
  const std::size_t channel = found->second;
  auto& all = static_cast<TypedChannel<Message>&>(*channels_[channel]).messages;
  if (!all.empty()) time_ns = std::max(time_ns, all.back().time_ns);
  all.push_back({time_ns, std::move(message)});
  note_message(channel, time_ns, &all.back().message);
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(too_old(all.size())));
}

template <class Message>
const std::vector<Stamped<Message>>& Log::messages(std::string_view topic) const {
  static const std::vector<Stamped<Message>> none;
  const auto found = numbers_.find(topic);
  if (found == numbers_.end()) return none;
  const AnyChannel& channel = *channels_[found->second];
  if (channel.type != &message_type<Message>()) return none;
  return static_cast<const TypedChannel<Message>&>(channel).messages;
}

}  // namespace outrider
