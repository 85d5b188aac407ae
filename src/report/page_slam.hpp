// Mapping from a recording, as the page reads it.
#pragma once

#include <vector>

#include "outrider/log/log.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider {

/// Returns the beliefs of a log.
std::vector<ReportBelief> beliefs_of(const Log& log);

/// Adds the mapping of a recording, if there is one, and its final path as the track.
void add_slam(PageReport& page, const Log& log);

}  // namespace outrider
