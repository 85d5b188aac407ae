// The report as JSON text and back; docs/report.md is the manual of the format.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// One object, UTF-8, keys in a fixed order. Numbers read back the same; what is only drawn (footprints,
/// profiles, the track) is rounded to 1e-6 first. Infinite or unknown numbers are null.
std::string to_json(const Report& report);

/// The same in one line, without its end.
std::string to_json_line(const Report& report);

/// Refuses text that is not a report of this version; the fault names the place that is missing or
/// wrong, as in targets[3].pose[1]. null is read as NaN, and refused in what is drawn. Unknown keys are
/// ignored. to_json() of the outcome is the text again.
Outcome<Report> report_from_json(std::string_view text);

}  // namespace outrider
