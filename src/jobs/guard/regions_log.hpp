// The log of firing regions: from where each target can be hit.
#pragma once

#include "outrider/jobs/guard/firing_map.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

/// Logs one grid for each target at `time_s`. O(cells * targets).
void log_firing_regions(Log& log, const GuardProblem& problem, const FiringMap& firing_map,
                        double time_s = 0.0);

}  // namespace outrider
