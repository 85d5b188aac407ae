#include "outrider/jobs/guard/job.hpp"

#include <fmt/format.h>

#include <utility>

#include "guard_log.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/job/plan_cache.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/rigid_world.hpp"
#include "outrider/jobs/guard/scout_run.hpp"
#include "outrider/jobs/guard/simulate.hpp"
#include "outrider/jobs/guard/supply_plan.hpp"
#include "pddl_task.hpp"
#include "regions_log.hpp"
#include "summary.hpp"
#include "team_job.hpp"
#include "yard_plan.hpp"

namespace outrider {
namespace {

/// The yard is still, or intruders come, or walk about, or those who are hit may survive.
Outcome<Report> carry_out(const GuardScenario& scenario, const FiringMap& firing_map, const GuardPlan& plan,
                          Log& log, const RunWatch& watch) {
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  const GuardProblem& problem = scenario.problem;
  const ArrivalOptions& arrivals = scenario.arrivals;
  if (scenario.wander.any()) {
    return simulate_moving_targets(problem, firing_map, scenario.preferences, scenario.history,
                                   scenario.wander, scenario.options, seed, log, watch, scenario.faults);
  }
  if (arrivals.any()) {
    return simulate_arriving_targets(problem, firing_map, plan, scenario.intruders, arrivals,
                                     scenario.options, seed, log, watch, scenario.faults);
  }
  if (arrivals.may_survive()) {
    return simulate_surviving_targets(problem, firing_map, plan, arrivals, scenario.options, seed, log, watch,
                                      scenario.faults);
  }
  return run_guard({.problem = problem,
                    .firing_map = firing_map,
                    .plan = plan,
                    .options = scenario.options,
                    .seed = seed,
                    .rigid = scenario.sim == "physics",
                    .faults = scenario.faults},
                   log, watch);
}

void finish(Run& run, Report report, double planning_s) {
  run.report = std::move(report);
  run.report.machine_times.insert(run.report.machine_times.begin(), {"planning_s", planning_s});
}

Status guard_known_yard(const GuardScenario& scenario, const std::string& key, Run& run,
                        const RunWatch& watch) {
  RunSteps steps(watch, 3);
  const double began_s = wall_s();
  const auto yard = plan_known_yard(scenario, key, steps, watch, run.log);
  if (!yard) return tl::unexpected<Fault>(yard.error());
  const double planned_s = wall_s();
  if (auto ok = steps.next("driving and shooting"); !ok) return ok;
  auto report = carry_out(scenario, (*yard)->firing_map, (*yard)->plan, run.log, steps.inner());
  if (!report) return tl::unexpected<Fault>(report.error());
  if (scenario.sim == "physics") report->machine_times.emplace_back("physics_s", wall_s() - planned_s);
  finish(run, std::move(*report), planned_s - began_s);
  return {};
}

/// Plans and shoots on what was found.
Status guard_found_yard(const GuardScenario& scenario, ScoutedYard& yard, RunSteps& steps, Run& run,
                        const RunWatch& watch) {
  if (auto ok = steps.next("planning on the map found"); !ok) return ok;
  const double began_s = wall_s();
  const auto firing_map = build_firing_map(yard.found.problem, scenario.options, watch.budget());
  if (!firing_map) return tl::unexpected<Fault>(firing_map.error());
  yard.found.problem.supplies.stations = stations_in_reach(yard.found.problem, *firing_map);
  const GuardProblem& found = yard.found.problem;
  const double explored_s = metric(yard.run.report, "time_s");
  if (scenario.regions) log_firing_regions(run.log, found, *firing_map, explored_s);
  const auto plan = plan_still_yard(scenario, found, *firing_map, watch, run.log, {}, explored_s);
  if (!plan) return tl::unexpected<Fault>(plan.error());
  const double planning_s = wall_s() - began_s;
  if (auto ok = steps.next("driving and shooting"); !ok) return ok;
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  auto report = run_guard_on_map(scenario.problem, yard, *firing_map, *plan, scenario.options, seed, run.log,
                                 steps.inner(), scenario.faults);
  if (!report) return tl::unexpected<Fault>(report.error());
  finish(run, std::move(*report), planning_s);
  return {};
}

/// The exploring comes first, and all plans are made on what it found. Whoever cancels the planning keeps
/// the exploring, and so does a plan that is refused.
Status guard_unknown_yard(const GuardScenario& scenario, Run& run, const RunWatch& watch) {
  RunSteps steps(watch, 3);
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  if (auto ok = steps.next("exploring the yard"); !ok) return ok;
  auto yard = scout(scenario.problem, {{}, scenario.sensors, scenario.scout}, seed, run.log, steps.inner());
  if (!yard) return tl::unexpected<Fault>(yard.error());
  if (yard->run.report.status == "cancelled") {
    run.report = std::move(yard->run.report);
    return {};
  }
  if (!yard->failure.empty()) {
    run.report = unguarded(scenario.problem, *yard, yard->failure);
    return {};
  }
  auto done = guard_found_yard(scenario, *yard, steps, run, watch);
  if (done) return done;
  if (done.error().code != FaultCode::cancelled) {
    run.report = unguarded(scenario.problem, *yard, done.error().sentence);
    return {};
  }
  run.report = std::move(yard->run.report);
  mark_cancelled(run.report, run.log, metric(run.report, "time_s"));
  return {};
}

}  // namespace

Outcome<Warnings> GuardJob::load() {
  const PddlOptions& pddl = scenario.pddl;
  if (pddl.write && !pddl.validate.empty()) {
    return bad_input(
        "a problem is written or a plan is judged; leave one of pddl.write and pddl.validate out",
        "pddl.validate");
  }
  auto warnings = load_problem(scenario);
  if (!warnings) return warnings;
  if (auto planner = find_guard_planner(scenario.options.planner); !planner) return pass_on(planner);
  if (scenario.sim == "physics") {
    if (auto bodies = make_rigid_world(scenario.problem); !bodies) return pass_on(bodies);
  }
  return warnings;
}

Status GuardJob::run(Run& run, const RunWatch& watch) {
  if (scenario.pddl.any()) return run_pddl(scenario, run, watch);
  log_yard(run.log, scenario.problem, scenario.options, static_cast<std::uint64_t>(scenario.seed),
           scenario.sim == "physics");
  if (scenario.scout.unknown && scenario.robots == 1) return guard_unknown_yard(scenario, run, watch);
  const std::string key = plan_key(options(), unplanned_options(scenario));
  return scenario.robots > 1 ? guard_with_team(scenario, key, run, watch)
                             : guard_known_yard(scenario, key, run, watch);
}

Job guard_job() {
  return {.name = "guard",
          .sentence = "Hit every target in a yard with a ballistic water gun, soonest.",
          .example = "guard --world yard.sdf --targets cats.txt --start 0,-9.5,90 --out out --html",
          .blank = [] { return std::make_unique<GuardJob>(); },
          .aliases = {{"planner", "plan.planner"},
                      {"prove", "plan.prove"},
                      {"unknown", "scout.unknown"},
                      {"pddl", "pddl.write"},
                      {"validate", "pddl.validate"},
                      {"validate-tolerance", "pddl.tolerance"}},
          .summary = guard_summary};
}

}  // namespace outrider
