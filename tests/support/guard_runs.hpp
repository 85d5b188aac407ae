// Guard missions of each kind in one call.
#pragma once

#include "outrider/jobs/guard/run.hpp"

namespace outrider::testing {

inline Report run_still(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                        const GuardOptions& options, std::uint64_t seed, const RunWatch& watch = {}) {
  return run_guard({problem, firing_map, plan, options, seed}, watch).value();
}

inline Report run_arrivals(const ArrivalPlan& plan, const GuardOptions& options, std::uint64_t seed,
                           const Survival& survival = {}, const RunWatch& watch = {}) {
  const GuardPlan none;
  return run_guard({plan.yard.problem, plan.yard.firing_map, none, options, seed, plan, survival}, watch)
      .value();
}

inline Report run_walkers(const MovingPlan& plan, const std::vector<Walk>& walks, const GuardOptions& options,
                          std::uint64_t seed, const RunWatch& watch = {}) {
  const GuardPlan none;
  const GuardRun run{.problem = plan.problem,
                     .firing_map = plan.firing_map,
                     .plan = none,
                     .options = options,
                     .seed = seed,
                     .walkers = WalkerRun{plan, walks}};
  return run_guard(run, watch).value();
}

}  // namespace outrider::testing
