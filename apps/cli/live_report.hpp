// Streams the report of a mission while it runs.
//
// A watching program sets OUTRIDER_LIVE to the number of an open descriptor (which may be that of
// OUTRIDER_PROGRESS) and reads one report per line from it. Each line holds what is new since the line before
// (report/growth.hpp); docs/server.md says how to combine them. At most five lines are written per second of
// wall time, and one at the end. A line longer than 4 MiB is replaced by
// {"omitted":"scene","bytes":5000000,"most_bytes":4194304}, or with "news".
#pragma once

#include <chrono>

#include "outrider/report/growth.hpp"
#include "watcher.hpp"

namespace outrider::cli {

class LiveReport final : public LogSink {
 public:
  LiveReport() : watcher_("OUTRIDER_LIVE") {}

  /// Returns true if a program watches.
  [[nodiscard]] bool is_watched() const { return watcher_.is_there(); }
  /// Writes the last line.
  void finish(const Log& log);

  void begin(const Log& log) override { log_ = &log; }
  void add_channel(const Channel&) override {}
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override;

 private:
  void send();

  Watcher watcher_;
  const Log* log_ = nullptr;
  ReportGrowth growth_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

}  // namespace outrider::cli
