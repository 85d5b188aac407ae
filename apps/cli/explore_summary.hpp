// An exploration in words for people, and in the JSON of the command line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "outrider/report/report.hpp"

namespace outrider::cli {

std::string explore_summary(const Report& report);

/// {"status", "job", "stop_reason", "reason", the metrics by their names, "refused": [{"x", "y", "reason"}],
/// "report", "warnings"}.
nlohmann::ordered_json explore_json(const Report& report, const std::string& stop_reason,
                                    const std::string& report_path);

}  // namespace outrider::cli
