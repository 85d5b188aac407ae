// to_log() turns a report into the messages of a log.
#pragma once

#include "outrider/log/log.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// Returns the messages of a run. Scans of a range finder are not in a report, and not in this log.
/// O(report), and O(cells) for each step in which a map has grown.
Log to_log(const Report& report);

}  // namespace outrider
