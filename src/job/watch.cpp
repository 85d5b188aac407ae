#include "outrider/job/watch.hpp"

#include <fmt/format.h>

#include "outrider/log/append.hpp"

namespace outrider {

Budget RunWatch::budget() const {
  Budget budget;
  budget.stop = stop;
  return budget;
}

RunSteps::RunSteps(const RunWatch& watch, int steps) : watch_(watch) { step_.steps = steps; }

Status RunSteps::next(const std::string& name) {
  if (watch_.stopped()) return fault(FaultCode::cancelled, "it was cancelled before: " + name);
  step_.name = name;
  ++step_.number;
  step_.part = 0.0;
  if (watch_.progress) watch_.progress(step_);
  return {};
}

RunWatch RunSteps::inner() const {
  RunWatch watch = watch_;
  if (!watch_.progress) return watch;
  watch.progress = [report = watch_.progress, step = step_](const RunStep& part) mutable {
    step.part = part.part;
    report(step);
  };
  return watch;
}

void mark_cancelled(Report& report, Log& log, double time_s) {
  report.status = "cancelled";
  report.reason = fmt::format("it was cancelled after {:.1f} s of the mission", time_s);
  log_event(log, time_s, "cancelled", "the mission was cancelled");
}

}  // namespace outrider
