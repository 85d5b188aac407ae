// A guard mission of several robots, from the scenario to the report.
#pragma once

#include "outrider/job/job.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/jobs/guard/team_run.hpp"

namespace outrider {

/// Surveys the yard and plans for the team, or takes both from the cache of the watch under the key;
/// simulates the team and logs. Faults: those of build_firing_map(), starts_of_team() and plan_team().
Status guard_with_team(const GuardScenario& scenario, const std::string& key, Run& run,
                       const RunWatch& watch);

/// Returns what a team came to. `log` holds its shots. Its status is "done" if every target that can be hit
/// was hit and closest_approach() finds that no two bodies overlapped at any time. Metrics are those of a
/// still yard (run.hpp) without the ones of the tour, with the makespans for the times, and robots, alone_s,
/// waited_s, given_up, stopped_balls and closest_m; the table `robots` has a row for each robot.
Report judged_team(const GuardScenario& scenario, const FiringMap& firing_map, const TeamPlan& plan,
                   const TeamRun& team, const Log& log);

}  // namespace outrider
