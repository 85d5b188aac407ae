// Simulations of intruders that come, survive or walk about: what they do is drawn, the plan that their kind
// needs is made, and one run (run.hpp) carries it out.
#pragma once

#include "outrider/jobs/guard/run.hpp"

namespace outrider {

/// Intruders come one after another. Policy and objective are those that `arrivals` names. `plan` is that for
/// all targets of the still yard, without stations. Refused as find_replan_policy(), find_objective(),
/// arrival_yard() and precompute_stops().
Outcome<Report> simulate_arriving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                          const GuardPlan& plan, const std::vector<Intruder>& intruders,
                                          const ArrivalOptions& arrivals, const GuardOptions& options,
                                          std::uint64_t seed, const RunWatch& watch = {});

/// Everybody is there from the start, and who is hit may survive. The policy is the one with the least
/// expected time (survivors.hpp, over 40 missions, with a beam of at most 4). Two more metrics: expected_s,
/// and expected_error_s, its standard error. Refused as arrival_yard() and precompute_stops().
Outcome<Report> simulate_surviving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardPlan& plan, const ArrivalOptions& arrivals,
                                           const GuardOptions& options, std::uint64_t seed,
                                           const RunWatch& watch = {});

/// Intruders walk about: walks are drawn from the seed, the map of where they rest is made of the history.
/// Refused as draw_walks() and plan_moving().
Outcome<Report> simulate_moving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                        const std::vector<double>& weights, const std::vector<Track>& history,
                                        const WanderOptions& wander, const GuardOptions& options,
                                        std::uint64_t seed, const RunWatch& watch = {});

}  // namespace outrider
