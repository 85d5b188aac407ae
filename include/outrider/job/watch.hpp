// RunWatch: how a caller follows a run and stops it: progress, the messages of its log, and a stop token.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/log/log.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

class PlanCache;

/// The progress of a run.
struct RunStep {
  std::string name;   ///< name of the present step
  int number = 0;     ///< number of the present step, from 1
  int steps = 1;      ///< number of steps in the run
  double part = 0.0;  ///< completed fraction of the present step, from 0 to 1
};

/// The caller's side of a run. A stop request ends the run; nothing else here changes its result.
struct RunWatch {
  std::stop_token stop = {};
  std::function<void(const RunStep&)> progress = {};  ///< called on the thread of the run
  std::vector<LogSink*> sinks = {};  ///< receive the messages of the log as they are appended
  PlanCache* plans = nullptr;  ///< shared with other runs (plan_cache.hpp); null: the run plans by itself

  /// Returns a budget that is limited by the stop token only.
  [[nodiscard]] Budget budget() const;
  [[nodiscard]] bool stopped() const { return stop.stop_requested(); }
  /// Reports the completed fraction of the present step, from 0 to 1.
  void part(double done) const {
    if (progress) progress({"", 1, 1, done});
  }
};

/// Sets the status of a report to "cancelled" and logs it. `time_s` is the mission time at which the mission
/// was stopped.
void mark_cancelled(Report& report, Log& log, double time_s);

/// Reports the steps of a run to a watch, in order.
class RunSteps {
 public:
  /// The watch must outlive this object.
  RunSteps(const RunWatch& watch, int steps);
  /// Begins the next step. Fault: cancelled, if a stop was requested.
  Status next(const std::string& name);
  /// Returns a watch for the code that does the present step. Progress reported to it counts for this step.
  [[nodiscard]] RunWatch inner() const;

 private:
  const RunWatch& watch_;
  RunStep step_;
};

}  // namespace outrider
