// A guard report in words for people, and in the JSON of the command line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "outrider/report/report.hpp"

namespace outrider::cli {

/// The headline, a table of the targets, and the totals.
std::string summary(const Report& report);

/// {"status", "job", "reason", "metrics", "targets", "report", "warnings"}, and "sim" where the report has
/// it. What is known of no shot at a target is null, and so is the path when it is empty.
nlohmann::ordered_json summary_json(const Report& report, const std::string& report_path);

/// Puts "planning_s", which no report holds because it differs from run to run, before "mission_s".
void insert_planning(nlohmann::ordered_json& summary, double planning_s);

}  // namespace outrider::cli
