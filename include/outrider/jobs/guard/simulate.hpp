// Simulations with intruders that arrive, survive hits or walk about. Each function draws the behaviour of
// the intruders, makes the plan for it, and carries it out with run_guard() (run.hpp).
#pragma once

#include "outrider/jobs/guard/run.hpp"

namespace outrider {

/// Simulates intruders that arrive one after another. `arrivals` names the policy and the objective. `plan`
/// is a plan for all targets standing still, without stations. Faults: those of find_replan_policy(),
/// find_objective(), arrival_yard() and precompute_stops().
Outcome<Report> simulate_arriving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                          const GuardPlan& plan, const std::vector<Intruder>& intruders,
                                          const ArrivalOptions& arrivals, const GuardOptions& options,
                                          std::uint64_t seed, Log& log, const RunWatch& watch = {},
                                          const GuardSimParams& faults = {});

/// Simulates intruders that are all inside from the start and may survive hits. The policy is the one with
/// the least expected time (survivors.hpp, estimated from 40 missions with a beam of at most 4). Additional
/// metrics: expected_s and its standard error expected_error_s. Faults: those of arrival_yard() and
/// precompute_stops().
Outcome<Report> simulate_surviving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardPlan& plan, const ArrivalOptions& arrivals,
                                           const GuardOptions& options, std::uint64_t seed, Log& log,
                                           const RunWatch& watch = {}, const GuardSimParams& faults = {});

/// Simulates intruders that walk about. Their walks are drawn from the seed; the visit map is learned from
/// the history. Faults: those of draw_walks() and plan_moving().
Outcome<Report> simulate_moving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                        const std::vector<double>& weights, const std::vector<Track>& history,
                                        const WanderOptions& wander, const GuardOptions& options,
                                        std::uint64_t seed, Log& log, const RunWatch& watch = {},
                                        const GuardSimParams& faults = {});

}  // namespace outrider
