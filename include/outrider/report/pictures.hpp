// Pictures of a report: a page that plays it, and a moving picture for a README.
#pragma once

#include <string>

#include "outrider/report/report.hpp"

namespace outrider {

/// One self-contained HTML page (no network, no other file) that plays the run: plan view with a time
/// slider, side view of the selected shot, table of targets, totals; light and dark.
std::string to_html(const Report& report);

/// A self-contained animated SVG (CSS/SMIL, no script) of the plan view, looping, the whole run in
/// `seconds` seconds.
std::string to_animated_svg(const Report& report, double seconds);

}  // namespace outrider
