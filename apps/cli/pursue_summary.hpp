// A pursuit in words for people, and in the JSON of the command line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "outrider/report/report.hpp"

namespace outrider::cli {

/// What no report holds, because it differs from run to run.
struct PursuitTimes {
  double first_feasible_s = -1.0;  ///< of planning until the first catch was known; negative: never
  double planning_s = 0.0;
  double peak_mib = 0.0;  ///< most memory of the process
};

std::string pursuit_summary(const Report& report);
std::string times_text(const PursuitTimes& times);

/// {"status", "job", "reason", "metrics", "report", "warnings"}. Numbers that are not known are null.
nlohmann::ordered_json pursuit_json(const Report& report, const std::string& report_path);
void insert_times(nlohmann::ordered_json& summary, const PursuitTimes& times);

}  // namespace outrider::cli
