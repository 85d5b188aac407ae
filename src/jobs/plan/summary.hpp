// What a person reads of an answer.
#pragma once

#include <string>

#include "outrider/report/report.hpp"

namespace outrider {

/// A line for each row of the answer.
std::string plan_summary(const Report& report);

}  // namespace outrider
