// What a mapping from a log came to, in words and as JSON, from its report alone.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "outrider/report/report.hpp"

namespace outrider::cli {

/// The report has the part slam.
std::string slam_summary(const Report& report);
nlohmann::ordered_json slam_json(const Report& report, const std::string& report_path);

}  // namespace outrider::cli
