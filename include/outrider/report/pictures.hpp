// Pictures of a run: an HTML page that plays it, and an animated SVG for a README.
#pragma once

#include <string>
#include <string_view>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// Returns an HTML page that plays a run. `mcap` is the log of the run as an MCAP file, `title` the title of the page,
/// which is escaped. `viewer` is the page without a run (the tool contains one, built from web/): HTML with the markers
/// @TITLE@ (text) and @LOG@ (base64, inside a script element), each once and in this order. O(length of all).
std::string to_html(const std::string& title, std::string_view mcap, std::string_view viewer);

/// Returns a self-contained animated SVG (SMIL, no script) of the plan view for use in an <img>. It plays the
/// whole run in one loop of `seconds` (1 to 600, clamped).
///
/// Flights play in slow motion: each takes at least 0.4 s, and all together take at most 45 % of the loop.
/// The last 6 % show the end. The motion is simplified with tolerances of 0.01 m and 0.005 rad. If the text
/// exceeds 400,000 bytes, the tolerances are doubled until it does not; the yard is never simplified. Shots
/// with unknown numbers are left out. Source of the simplification: Douglas and Peucker, Cartographica 10
/// (1973) 112-122.
std::string to_animated_svg(const PageReport& report, double seconds);

}  // namespace outrider
