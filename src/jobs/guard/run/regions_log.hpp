// The log of planning: from where targets can be hit, the flights that come nearest to those that cannot, and
// the tours found.
#pragma once

#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

/// Logs one grid for each target at `time_s`. O(cells * targets).
void log_firing_regions(Log& log, const GuardProblem& problem, const FiringMap& firing_map,
                        double time_s = 0.0);

/// Logs one grid for all targets. O(cells * targets).
void log_firing_map(Log& log, const FiringMap& firing_map, double time_s = 0.0);

/// Logs for each target that cannot be hit the flight that comes nearest to a hit.
void log_blocked_flights(Log& log, const GuardProblem& problem, const FiringMap& firing_map,
                         double time_s = 0.0);

/// Logs a tour.
void log_tour(Log& log, const GuardProblem& problem, const TourDraft& tour, double time_s = 0.0);

}  // namespace outrider
