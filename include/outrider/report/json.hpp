// The report as JSON text and back; docs/report.md is the manual of the format.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider {

/// Returns the report as one JSON object in UTF-8 with keys in a fixed order. Numbers read back unchanged,
/// except that values which are only drawn (footprints, profiles, the track) are rounded to 1e-6. Infinite
/// and unknown numbers are null.
std::string to_json(const PageReport& report);

/// Reads a report. to_json() of the outcome is the same text again. Reads null as NaN, but refuses null in
/// values that are drawn. Ignores unknown keys. Faults: bad_input on text that is not a report of this
/// version; the fault names the missing or wrong place, as in targets[3].pose[1].
Outcome<PageReport> report_from_json(std::string_view text);

}  // namespace outrider
