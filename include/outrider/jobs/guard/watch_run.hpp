// A whole watch, simulated: intruders come, the policy plans, the robot drives and shoots, a report tells.
#pragma once

#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/guard_robot.hpp"
#include "outrider/jobs/guard/survivors.hpp"
#include "outrider/jobs/guard/watch_mission.hpp"

namespace outrider {

/// The report is a pure function of the arguments, the observer left out. Its targets are the intruders, with
/// their visits. Metrics that a guard run has not: intruder_seconds, the time inside of all intruders that
/// can be hit, summed, where who is not hit stays until the end; makespan_s, when the last of them was hit
/// (the end when one was not); longest_s, the longest time inside; plans; the bounds of watch_bound.hpp.
Report run_watch(const WatchPlan& plan, const GuardOptions& options, std::uint64_t seed,
                 const Survival& survival = {}, const RunWatch& watch = {});

/// The same from a surveyed yard and the plan for all its targets: the outlook is made, the policy and the
/// objective are those that `arrivals` names. Refused as find_watch_policy(), find_objective(),
/// watch_over() and look_out().
Outcome<Report> keep_watch(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                           const std::vector<Intruder>& intruders, const ArrivalOptions& arrivals,
                           const GuardOptions& options, std::uint64_t seed, const RunWatch& watch = {});

/// The still yard when who is hit may survive: everybody is there from the start, and the manner is the one
/// with the least expected time (survivors.hpp, over 40 missions, with a beam of at most 4). Two more
/// metrics: expected_s, and expected_error_s, its standard error. Refused as watch_over() and look_out().
Outcome<Report> wear_down(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                          const ArrivalOptions& arrivals, const GuardOptions& options, std::uint64_t seed,
                          const RunWatch& watch = {});

}  // namespace outrider
