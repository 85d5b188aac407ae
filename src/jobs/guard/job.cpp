#include "outrider/jobs/guard/job.hpp"

#include <utility>

#include "outrider/job/clock.hpp"
#include "outrider/jobs/guard/run/robot.hpp"
#include "outrider/jobs/guard/run/scout_run.hpp"
#include "run/guard_log.hpp"

namespace outrider {
namespace {

/// Plans and shoots in the yard as it is known: all of it, or what was found of it.
Status guard_yard(const GuardScenario& scenario, const ScoutedYard* scouted, RunSteps& steps, Run& run,
                  const RunWatch& watch) {
  const double began_s = wall_s();
  GuardScenario known = scenario;
  if (scouted != nullptr) known.problem = scouted->found.problem;
  const double explored_s = scouted != nullptr ? metric(scouted->run.report, "time_s") : 0.0;
  const auto guard = prepare_guard(std::move(known), steps, watch, run.log, explored_s);
  if (!guard) return pass_on(guard);
  const double planned_s = wall_s();
  if (auto ok = steps.next("driving and shooting"); !ok) return ok;
  std::optional<TrueYard> truth;
  if (scouted != nullptr) {
    auto yard = begin_on_map(scenario.problem, *scouted, scenario.options, watch.budget(), run.log);
    if (!yard) return pass_on(yard);
    truth = std::move(*yard);
  }
  auto report = run_guard({**guard, truth ? &*truth : nullptr}, run.log, steps.inner());
  if (!report) return pass_on(report);
  if (truth) add_exploring(*report, scenario.problem, *scouted, *truth, run.log);
  if (scenario.sim == "physics") report->machine_times.emplace_back("physics_s", wall_s() - planned_s);
  report->machine_times.insert(report->machine_times.begin(), {"planning_s", planned_s - began_s});
  run.report = std::move(*report);
  return {};
}

/// The exploring comes first, and all plans are made on what it found. Whoever cancels the planning keeps
/// the exploring, and so does a plan that is refused.
Status explore_and_guard(const GuardScenario& scenario, Run& run, const RunWatch& watch) {
  RunSteps steps(watch, 4);
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  if (auto ok = steps.next("exploring the yard"); !ok) return ok;
  ScoutTask task;
  task.sensors.laser = scenario.navigation.laser;
  task.sensors.wheels = scenario.navigation.wheels;
  task.options = scenario.scout;
  auto yard = scout(scenario.problem, task, seed, run.log, steps.inner());
  if (!yard) return pass_on(yard);
  const bool explored = yard->run.report.status != "cancelled";
  std::string failure = yard->failure;
  if (explored && failure.empty()) {
    const auto done = guard_yard(scenario, &*yard, steps, run, watch);
    if (done) return done;
    if (done.error().code != FaultCode::cancelled) failure = done.error().sentence;
  }
  if (!failure.empty()) {
    run.report = unguarded(scenario.problem, *yard, failure);
    return {};
  }
  run.report = std::move(yard->run.report);
  if (explored) mark_cancelled(run.report, run.log, metric(run.report, "time_s"));
  return {};
}

}  // namespace

Outcome<Warnings> GuardJob::load() {
  auto warnings = load_problem(scenario);
  if (warnings && scenario.sim == "physics") {
    if (auto bodies = make_rigid_world(rigid_scene(scenario.problem)); !bodies) return pass_on(bodies);
  }
  return warnings;
}

Status GuardJob::run(Run& run, const RunWatch& watch) {
  log_yard(run.log, scenario.problem, scenario);
  if (scenario.scout.unknown) return explore_and_guard(scenario, run, watch);
  RunSteps steps(watch, 3);
  return guard_yard(scenario, nullptr, steps, run, watch);
}

Job guard_job() {
  return {.name = "guard",
          .sentence = "Hit every target in a yard with a ballistic water gun, soonest.",
          .example = "guard --world yard.sdf --targets cats.txt --start 0,-9.5,90 --out out --html",
          .blank = [] { return std::make_unique<GuardJob>(); },
          .aliases = {{"planner", "plan.planner"}, {"prove", "plan.prove"}, {"unknown", "scout.unknown"}},
          .summary = guard_summary};
}

}  // namespace outrider
