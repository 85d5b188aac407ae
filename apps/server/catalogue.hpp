// What the tool can do, as the page asks for it: path planners and jobs with the options that describe
// themselves.
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "outrider/core/options.hpp"

namespace outrider::server {

/// A job with its scenario's options at their defaults.
struct JobForm {
  std::string name;
  std::string sentence;
  std::vector<OptionGroup> groups;
};

/// The present value in the unit of the option.
Json value_json(const Option& option);

/// {"name", "type", "unit", "low", "high", "default", "sentence"}; low and high of numbers only.
Json option_json(const Option& option);

/// {"path_planners": [...], "jobs": [...]}
Json catalogue_json(const std::vector<JobForm>& jobs);

}  // namespace outrider::server
