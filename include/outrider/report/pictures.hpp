// The page of a report: one HTML file that plays it.
#pragma once

#include <string>
#include <string_view>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// Returns an HTML page that plays the report. `viewer` is the page without a report (the tool contains one,
/// built from web/): HTML with the markers @TITLE@ (text) and @REPORT@ (JSON, inside a script element), each
/// once and in this order. All names in the report are escaped. O(length of both).
std::string to_html(const PageReport& report, std::string_view viewer);

}  // namespace outrider
