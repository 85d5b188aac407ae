// McapSink writes a log to an MCAP file while it grows.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/log/log.hpp"
#include "outrider/log/mcap/mcap_writer.hpp"

namespace outrider {

/// The first fault of the writer ends the writing; finish() returns it.
class McapSink final : public LogSink {
 public:
  explicit McapSink(McapWriter begun) : writer_(std::move(begun)) {}

  void add_channel(const Channel& channel) override { numbers_.push_back(writer_.add_channel(channel)); }
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override {
    if (status_) status_ = writer_.write(numbers_[channel], time_ns, data);
  }

  /// Returns the writer, for attachments.
  McapWriter& writer() { return writer_; }
  /// Completes the file. Fault: that of the first call that failed.
  Status finish() { return status_ ? writer_.finish() : status_; }

 private:
  McapWriter writer_;
  std::vector<std::size_t> numbers_;  ///< by channel of the log: its number in the file
  Status status_;
};

}  // namespace outrider
