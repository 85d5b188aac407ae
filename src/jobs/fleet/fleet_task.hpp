// The work of the job fleet between its options and its report.
#pragma once

#include "outrider/jobs/fleet/job.hpp"

namespace outrider {

/// Reads the files of the scenario. Faults: bad_input with the file and line, or with the key.
Outcome<FleetProblem> load_fleet(const FleetScenario& scenario);

/// Logs the cells, starts and goals, and, if there is a plan, the path of each robot on "/plan/NAME" with the
/// time of each step, 1 s a step.
void log_fleet(Log& log, const FleetProblem& problem, const FleetScenario& scenario, const FleetPlan* plan);

/// Returns metrics and the table "rows", one row for each robot.
Report fleet_report(const FleetProblem& problem, const FleetPlan& plan);

/// Returns what a person reads of a run.
std::string fleet_summary(const Report& report);

}  // namespace outrider
