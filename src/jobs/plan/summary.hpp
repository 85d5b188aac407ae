// What a person reads of an answer.
#pragma once

#include <string>

#include "outrider/job/job.hpp"

namespace outrider {

/// A line of the shortest path.
std::string plan_summary(const Report& report);

/// A line for each row of the answer, which is the first table of the run.
std::string plan_run_summary(const Run& run);

}  // namespace outrider
