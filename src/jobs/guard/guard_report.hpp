// The report of a guard mission: its scene, an entry for each target, status and metrics, by capability.
#pragma once

#include "outrider/jobs/guard/run.hpp"

namespace outrider {

/// The yard as it really is.
const GuardProblem& true_problem(const GuardRun& run);
const FiringMap& true_map(const GuardRun& run);
/// Returns the intruders that the simulation lets come, survive or walk.
TargetSimParams target_params(const GuardRun& run);

/// Job, seed, world, robot, start and stations: what is known before anything happens.
Report opened_report(const GuardRun& run);

/// An entry for each target or intruder, as it is by now; the report holds the shots already.
void list_targets(Report& report, const GuardRun& run, const GuardMission& mission, const SimRecord& record);

/// The first store that ran empty, in a sentence; empty when none did.
std::string ran_dry(const Report& report);

/// What is added to the reason of a mission that ended because no station was left; empty for any other.
std::string why_stranded(const Report& report);

/// Moves the record into the report and concludes: targets, status, reason and metrics.
void close_report(Report& report, const GuardRun& run, const GuardMission& mission, SimRecord& record,
                  double expected_hits);

}  // namespace outrider
