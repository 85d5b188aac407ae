// The picture of a drive: the truth against what the robot believed, on the ground and over time.
#pragma once

#include <string>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// A self-contained SVG. Above, the ground: solids, tags with the side they are read from, waypoints with
/// their headings, the true way, the believed way, and ellipses of two standard deviations of the belief,
/// in a closed loop five times as large as they are. Below, how far the belief was from the truth, with the
/// band of two standard deviations, and a mark for each look that used a tag. The report has a drive.
std::string drive_picture(const PageReport& report);

}  // namespace outrider
