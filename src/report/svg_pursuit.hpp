// The picture of a pursuit: the map of costs with everybody's ways, and what it cost over time.
#pragma once

#include <string>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// A self-contained SVG: above, the ways over the map, with dots that go along them in a loop of `seconds`;
/// below, paid and proven over the seconds of the mission, and what planning knew over its time. The
/// report has a pursuit.
std::string pursuit_picture(const PageReport& report, double seconds);

}  // namespace outrider
