// A drive in words for people, and in the JSON of the command line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "outrider/report/report.hpp"

namespace outrider::cli {

std::string drive_summary(const Report& report);

/// {"status", "job", "reason", "waypoints": [{"dx", "dy", "dtheta"}], the metrics by their names, "report",
/// "warnings"}. A waypoint that was not reached, or passed by, has nulls.
nlohmann::ordered_json drive_json(const Report& report, const std::string& report_path);

}  // namespace outrider::cli
