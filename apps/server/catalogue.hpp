// The abilities of the tool for the page: path planners and jobs, with their self-describing options.
#pragma once

#include <vector>

#include "fields.hpp"
#include "outrider/job/job.hpp"

namespace outrider::server {

/// Returns the current value in the unit of the option.
Json value_json(const Option& option);

/// Returns {"name", "type", "unit", "low", "high", "default", "sentence"}; low and high for numbers only.
Json option_json(const Option& option);

/// Returns {"path_planners": [...], "jobs": [...]}, each with its options at their defaults.
Json catalogue_json(const std::vector<Job>& jobs);

}  // namespace outrider::server
