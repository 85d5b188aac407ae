// Runs as bytes, to compare them by.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "outrider/job/job.hpp"
#include "outrider/log/mcap/mcap_sink.hpp"
#include "outrider/log/messages/known_messages.hpp"
#include "outrider/report/run_json.hpp"

namespace outrider::test {

/// Keeps what it is sent as an MCAP file but for one topic, also when the log was there before it. Expects
/// that each message can be decoded.
class LogRecorder final : public LogSink {
 public:
  explicit LogRecorder(std::string without = "") : without_(std::move(without)) {}
  void add_channel(const Channel& channel) override {
    auto message = AnyMessage::of(channel);
    EXPECT_TRUE(message && *message) << channel.topic << " has the type " << channel.type;
    messages_.push_back(message ? std::move(*message) : std::nullopt);
    channels_.push_back(channel);
  }
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override {
    if (messages_.at(channel)) {
      EXPECT_TRUE(messages_[channel]->decode(data));
    }
    if (channels_[channel].topic == without_) return;
    // A sink that is added late receives all channels first. The file gets each channel with its first
    // message.
    const auto [number, is_new] = numbers_.try_emplace(channel, numbers_.size());
    if (is_new) file_.add_channel(channels_[channel]);
    file_.append(number->second, time_ns, data);
  }
  /// Completes the file and returns it. Call it once.
  std::string finish() {
    EXPECT_TRUE(file_.finish());
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
  McapSink file_{McapWriter::begin(make_string_sink(bytes_), {.compression = Codec::none}).value()};
  std::vector<std::optional<AnyMessage>> messages_;
  std::vector<Channel> channels_;
  std::string without_;
  std::map<std::size_t, std::size_t> numbers_;  ///< channel of the log -> channel of the file
};

/// Returns the report without its processing times, so that the same task has the same report.
inline Report without_machine_times(Report report) {
  report.machine_times.clear();
  for (Table& table : report.tables) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (std::ranges::count(table.machine_times, table.columns[i]) == 0) continue;
      for (auto& row : table.rows) row[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return report;
}

/// The log of a run as an MCAP file, as a LogRecorder has it.
inline std::string bytes_of_log(Log& log, std::string without = "") {
  LogRecorder recorder(std::move(without));
  log.add_sink(recorder);
  log.remove_sink(recorder);
  return recorder.finish();
}

/// All of a run that must repeat: its report but for how long the machine took, its log, and the names of its
/// files.
inline std::string bytes_of_run(Run& run) {
  const Report report = without_machine_times(run.report);
  std::string bytes = run_json<nlohmann::ordered_json>(report).dump();
  for (const auto& [key, value] : report.settings) bytes += "\n" + key + " = " + value;
  for (const NamedContent& file : run.files) bytes += "\n" + file.path;
  return bytes + bytes_of_log(run.log);
}
inline std::string bytes_of_run(Run&& run) { return bytes_of_run(run); }

}  // namespace outrider::test
