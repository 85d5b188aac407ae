// What the tool can do, as the page asks for it: path planners and jobs with the options that describe
// themselves.
#pragma once

#include <vector>

#include "fields.hpp"
#include "outrider/job/job.hpp"

namespace outrider::server {

/// The present value in the unit of the option.
Json value_json(const Option& option);

/// {"name", "type", "unit", "low", "high", "default", "sentence"}; low and high of numbers only.
Json option_json(const Option& option);

/// {"path_planners": [...], "jobs": [...]}, each with its options at their defaults.
Json catalogue_json(const std::vector<Job>& jobs);

}  // namespace outrider::server
