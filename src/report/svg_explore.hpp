// The picture of exploring: the map over the truth as it was discovered, and the way that did it.
#pragma once

#include <string>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// A self-contained SVG in a loop of `seconds`: the cells of the map as they came to be known, the true
/// walls, the true and the believed way with ellipses of two standard deviations, refused frontiers, home.
/// The report has an exploration.
std::string explore_picture(const PageReport& report, double seconds);

}  // namespace outrider
