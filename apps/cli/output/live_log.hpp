// LiveLog: the log of a run for a program that watches, while the run goes on.
//
// The program sets OUTRIDER_LIVE to the number of an open descriptor, another one than that of
// OUTRIDER_PROGRESS, and reads an MCAP file from it: the messages in chunks without compression, at the end
// run.json as an attachment and the index. A message is written at most 0.2 s after it was appended. The
// program must keep reading, because the run waits while the descriptor is full. If the program is gone, the
// run goes on without it.
#pragma once

#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "outrider/log/mcap/mcap_sink.hpp"

namespace outrider::cli {

class LiveLog final : public LogSink {
 public:
  /// Reads the variable and begins the log. Nobody watches if the variable names no open descriptor.
  LiveLog();
  /// Writes what was appended so far, if the log was not completed: it reads as one that was cut.
  ~LiveLog() override;
  LiveLog(const LiveLog&) = delete;
  LiveLog& operator=(const LiveLog&) = delete;

  [[nodiscard]] bool is_watched() const { return sink_.has_value(); }
  void add_channel(const Channel& channel) override;
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override;
  /// Completes the log; `result` is the text of run.json. A log that is not completed reads as one that was
  /// cut.
  void finish(const std::string& result);

 private:
  void flush_often(const std::stop_token& stop);

  std::mutex mutex_;  // guards the sink
  std::optional<McapSink> sink_;
  std::jthread flusher_;  // the last member: it ends first
};

}  // namespace outrider::cli
