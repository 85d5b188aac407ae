// RunWatch: how a caller follows a run and stops it: progress, the growing report, and a stop token.
#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "outrider/core/budget.hpp"
#include "outrider/report/growth.hpp"

namespace outrider {

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
  RunObserver* observer = nullptr;                    ///< receives the report while it grows; may be null

  /// Returns a budget that is limited by the stop token only.
  [[nodiscard]] Budget budget() const;
  [[nodiscard]] bool stopped() const { return stop.stop_requested(); }
  /// Returns true if there is an observer and it wants the report now.
  [[nodiscard]] bool wanted() const { return observer != nullptr && observer->wants(); }
  /// Passes the report to the observer, if there is one.
  void show(const Report& so_far) const {
    if (observer != nullptr) observer->see(so_far);
  }
  /// Reports the completed fraction of the present step, from 0 to 1.
  void part(double done) const {
    if (progress) progress({"", 1, 1, done});
  }
};

/// Sets the status of a report to "cancelled". `time_s` is the mission time at which the mission was stopped.
void mark_cancelled(Report& report, double time_s);

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
