// A whole hunt, simulated: the intruders wander, the robot learns where they like to be, leads and shoots.
#pragma once

#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/hunt_mission.hpp"

namespace outrider {

/// Runs a hunt of targets that walk as `walks` say. A pure function of the arguments, the observer left out.
/// The report has the moves of each target at every look: where it was, and where the robot, before that
/// look, believed that it would be. Metrics that a guard run has not: intruder_seconds, the time until they
/// were hit, summed, where who is not hit counts until the end; makespan_s; chance, the mean of the stated
/// chances of the shots; expected_hits, their sum.
Report run_hunt(const HuntPlan& plan, const std::vector<Walk>& walks, const GuardOptions& options,
                std::uint64_t seed, const RunWatch& watch = {});

/// The same from a surveyed yard: walks are drawn from the seed, the map is made of the history. Refused as
/// draw_walks() and plan_hunt(), and where there is air or ground that is not flat.
Outcome<Report> hunt(const GuardProblem& problem, const Site& site, const std::vector<double>& weights,
                     const std::vector<Track>& history, const WanderOptions& wander,
                     const GuardOptions& options, std::uint64_t seed, const RunWatch& watch = {});

}  // namespace outrider
