// The jobs of Outrider, by name.
#pragma once

#include <string>
#include <vector>

#include "outrider/job/run_job.hpp"

namespace outrider {

/// A row for each job; the order is that of their names.
const std::vector<Job>& jobs();

/// Runs the job in a scenario file: run_job(jobs(), ...).
Outcome<Run> run_job(const std::string& scenario_path, const Changes& changes = {},
                     const RunWatch& watch = {});

}  // namespace outrider
