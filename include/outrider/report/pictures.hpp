// Pictures of a report: a page that plays it, and a moving picture for a README.
#pragma once

#include <string>
#include <string_view>

#include "outrider/report/report.hpp"

namespace outrider {

/// The report in a page that shows it. `viewer` is that page (the tool holds one, made of web/): HTML with
/// each of the markers @TITLE@ (text) and @REPORT@ (JSON, inside of a script element) once, in this order.
/// Names in the report can be anything: none of them becomes markup. O(length of both).
std::string to_html(const Report& report, std::string_view viewer);

/// A self-contained animated SVG (SMIL, no script) of the plan view, the whole run in one loop of
/// `seconds` (1 to 600, clamped), fit for an <img>.
///
/// Flights are slowed so that they can be seen: at least 0.4 s each, all together at most 45 % of the
/// loop; the last 6 % show the end. The motion is simplified to within 0.01 m and 0.005 rad; where the
/// text would exceed 400,000 bytes, both are doubled until it does not (the yard itself is not
/// simplified). Shots with numbers that are not known are left out.
/// Source of the simplification: Douglas and Peucker, Cartographica 10 (1973) 112-122.
std::string to_animated_svg(const Report& report, double seconds);

}  // namespace outrider
