// A guard report in words for people, and in the JSON of the command line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "outrider/report/report.hpp"

namespace outrider::cli {

/// The headline, a table of the targets, and the totals.
std::string summary(const Report& report);

/// {"status", "job", "reason", "metrics", "targets", "report"}; `planning_s` joins the metrics.
nlohmann::ordered_json summary_json(const Report& report, double planning_s, const std::string& report_path);

}  // namespace outrider::cli
