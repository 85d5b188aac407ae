// What a mission tells of its report while it runs.
//
// Programs that watch set OUTRIDER_LIVE to the number of an open descriptor (it may be that of
// OUTRIDER_PROGRESS), and read from it a report a line, each with what is new since the line before
// (report/growth.hpp): docs/server.md says how they are put together. At most five lines come in a second of
// the clock on the wall, and one at the end; of a line that would be longer than 4 MiB only that is told:
// {"omitted":"scene","bytes":5000000,"most_bytes":4194304}, or "news".
#pragma once

#include <chrono>

#include "outrider/report/growth.hpp"
#include "watcher.hpp"

namespace outrider::cli {

class LiveReport final : public RunObserver {
 public:
  LiveReport() : watcher_("OUTRIDER_LIVE") {}

  /// Itself; null where nobody watches.
  RunObserver* observer() { return watcher_.is_there() ? this : nullptr; }

  bool wants() override;
  void see(const Report& so_far) override;

 private:
  Watcher watcher_;
  ReportGrowth growth_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace outrider::cli
