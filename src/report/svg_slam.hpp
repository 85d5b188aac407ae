// The moving picture of mapping from a log.
#pragma once

#include <string>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// A self-contained SVG: the map as it grows, the way as settled in the end and as it was believed, odometry
/// and reference, landmarks and loops from when they were known, in a loop of `seconds`. The report has the
/// part slam.
std::string slam_picture(const PageReport& report, double seconds);

}  // namespace outrider
