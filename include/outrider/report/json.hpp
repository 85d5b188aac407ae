// The report as JSON text and back; docs/report.md is the manual of the format.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// One object, UTF-8, keys in a fixed order, numbers in the shortest form that reads back the same.
std::string to_json(const Report& report);

/// Refuses text that is not a report of this version; the fault names the key that is missing or wrong.
Outcome<Report> report_from_json(std::string_view text);

}  // namespace outrider
