// Runs as the page reads them: report and log in one.
#pragma once

#include <limits>
#include <string_view>
#include <utility>

#include "outrider/core/outcome.hpp"
#include "outrider/job/watch.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider {

/// The metric of that name; NaN if the run has none.
inline double metric(const PageReport& page, std::string_view name) {
  for (const auto& [key, value] : page.metrics) {
    if (key == name) return value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

namespace testing {

/// Calls `run` with a log that sends its messages to the sink of the watch. It returns a report or a fault.
template <class Function>
Outcome<PageReport> paged(const RunWatch& watch, const Function& run) {
  Log log;
  for (LogSink* sink : watch.sinks) log.add_sink(*sink);
  Outcome<Report> report = run(log);
  if (!report) return pass_on(report);
  return page_report(*report, log);
}

}  // namespace testing
}  // namespace outrider
