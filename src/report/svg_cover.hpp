// The picture of covering: the area, and the strip over it as it was driven.
#pragma once

#include <string>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// A self-contained SVG in a loop of `seconds`: the area, what of it is out of reach, the track as it was
/// planned, the covered strip as it grows, and in the end what was missed. The report is of covering.
std::string cover_picture(const PageReport& report, double seconds);

}  // namespace outrider
