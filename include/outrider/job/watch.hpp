// Who watches a run: progress, the report while it grows, and the token that stops it.
#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "outrider/core/budget.hpp"
#include "outrider/report/growth.hpp"

namespace outrider {

/// How far a run is.
struct RunStep {
  std::string name;   ///< what it is at
  int number = 0;     ///< of the step, from 1
  int steps = 1;      ///< in all
  double part = 0.0;  ///< of the step that is done, from 0 to 1
};

/// Nothing of it changes what happens, but that a raised token ends the run.
struct RunWatch {
  std::stop_token stop = {};
  std::function<void(const RunStep&)> progress = {};  ///< called from the thread of the run
  RunObserver* observer = nullptr;                    ///< sees the report while it grows

  /// No limit but the token.
  [[nodiscard]] Budget budget() const;
  [[nodiscard]] bool stopped() const { return stop.stop_requested(); }
  /// True when somebody looks on and wants to see the report now.
  [[nodiscard]] bool wanted() const { return observer != nullptr && observer->wants(); }
  /// Shows the report, where somebody looks on.
  void show(const Report& so_far) const {
    if (observer != nullptr) observer->see(so_far);
  }
  /// Tells that this part of the present step is done, from 0 to 1.
  void part(double done) const {
    if (progress) progress({"", 1, 1, done});
  }
};

/// Marks a report as that of a mission that was stopped at that time of its clock.
void mark_cancelled(Report& report, double time_s);

/// Tells a watch of the steps of a run, in order.
class RunSteps {
 public:
  /// The watch must outlive it.
  RunSteps(const RunWatch& watch, int steps);
  /// The next step begins. Fault: cancelled, when the token is raised.
  Status next(const std::string& name);
  /// A watch for what does the present step: the parts that it tells are of this step.
  [[nodiscard]] RunWatch inner() const;

 private:
  const RunWatch& watch_;
  RunStep step_;
};

}  // namespace outrider
