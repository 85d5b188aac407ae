// The answer as text for people.
#pragma once

#include <string>

#include "outrider/report/report.hpp"

namespace outrider {

/// Returns a line for each row of the answer.
std::string plan_summary(const Report& report);

}  // namespace outrider
