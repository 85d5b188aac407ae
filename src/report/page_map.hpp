// The map and the laser of a log, as the page reads them.
#pragma once

#include <optional>

#include "outrider/log/log.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider {

/// Returns the map in its final state, and when each cell first became known.
ReportMap page_map(const Log& log);

/// Returns the range finder whose scans are in the log; nothing if there are none.
std::optional<ReportLaser> laser_of(const Log& log);

}  // namespace outrider
