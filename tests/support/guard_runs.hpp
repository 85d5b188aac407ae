// Guard missions of each kind in one call.
#pragma once

#include "outrider/jobs/guard/run/run.hpp"
#include "support/logged_run.hpp"
#include "support/planned_yard.hpp"

namespace outrider::testing {

inline Run carried_out(const GuardRun& run, const RunWatch& watch) {
  return logged_run(watch, [&](Log& log) { return run_guard(run, log, watch); }).value();
}

inline Run run_still(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                     const GuardOptions& options, std::uint64_t seed, const RunWatch& watch = {}) {
  return carried_out({{problem, firing_map, plan}, options, seed}, watch);
}

struct YardRun : PlannedYard {
  Run run;
};

/// Plans with the options and runs the plan.
inline YardRun run_yard(GuardProblem problem, const GuardOptions& options, std::uint64_t seed) {
  PlannedYard yard = planned_yard(std::move(problem), options);
  Run run = run_still(yard.problem, yard.firing_map, yard.plan, options, seed);
  return {std::move(yard), std::move(run)};
}

inline Run run_arrivals(const ArrivalPlan& plan, const GuardOptions& options, std::uint64_t seed,
                        const Survival& survival = {}, const RunWatch& watch = {}) {
  return carried_out({GuardMission(plan), options, seed, survival}, watch);
}

inline Run run_walkers(const MovingPlan& plan, const std::vector<Walk>& walks, const GuardOptions& options,
                       std::uint64_t seed, const RunWatch& watch = {}) {
  return carried_out({.mission = GuardMission(plan), .options = options, .seed = seed, .walks = walks},
                     watch);
}

}  // namespace outrider::testing
