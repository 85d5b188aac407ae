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

class LiveReport final : public RunObserver {
 public:
  LiveReport() : watcher_("OUTRIDER_LIVE") {}

  /// Returns this object; null if no program watches.
  RunObserver* observer() { return watcher_.is_there() ? this : nullptr; }

  bool wants() override;
  void see(const Report& so_far) override;

 private:
  Watcher watcher_;
  ReportGrowth growth_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace outrider::cli
