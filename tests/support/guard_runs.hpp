// Guard missions of each kind in one call.
#pragma once

#include "outrider/jobs/guard/run/run.hpp"
#include "support/logged_run.hpp"
#include "support/planned_yard.hpp"

namespace outrider::testing {

/// Runs a mission that was not made by prepare_guard(); `scenario` says all but the problem.
inline Run carried_out(GuardScenario scenario, GuardMission mission, const RunWatch& watch,
                       std::vector<Walk> walks = {}) {
  PreparedGuard guard{std::move(scenario)};
  guard.mission = std::move(mission);
  return logged_run(watch, [&](Log& log) { return run_guard({guard, {}, walks}, log, watch); }).value();
}

inline GuardScenario settings(const GuardOptions& options, std::uint64_t seed) {
  GuardScenario scenario;
  scenario.options = options;
  scenario.seed = static_cast<std::int64_t>(seed);
  return scenario;
}

inline Run run_still(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                     const GuardOptions& options, std::uint64_t seed, const RunWatch& watch = {}) {
  return carried_out(settings(options, seed), {problem, firing_map, plan}, watch);
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

inline Run run_arrivals(const RollingPlan& plan, const GuardOptions& options, std::uint64_t seed,
                        const Survival& survival = {}, const RunWatch& watch = {}) {
  GuardScenario scenario = settings(options, seed);
  scenario.arrivals.leave = survival.leave;
  scenario.arrivals.walk_mps = survival.walk_mps;
  return carried_out(std::move(scenario), GuardMission(plan), watch);
}

inline Run run_walkers(const MovingPlan& plan, const std::vector<Walk>& walks, const GuardOptions& options,
                       std::uint64_t seed, const RunWatch& watch = {}) {
  return carried_out(settings(options, seed), GuardMission(plan), watch, walks);
}

}  // namespace outrider::testing
