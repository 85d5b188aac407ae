// A covered area in words for people, and in the JSON of the command line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "outrider/report/report.hpp"

namespace outrider::cli {

std::string cover_summary(const Report& report);

/// {"status", "job", "reason", the metrics by their names, "report", "warnings"}.
nlohmann::ordered_json cover_json(const Report& report, const std::string& report_path);

}  // namespace outrider::cli
