#include "outrider/jobs/guard/job.hpp"

#include <fmt/format.h>

#include <utility>

#include "outrider/job/clock.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/guard_run.hpp"
#include "outrider/jobs/guard/hunt_run.hpp"
#include "outrider/jobs/guard/passing_plan.hpp"
#include "outrider/jobs/guard/physics_run.hpp"
#include "outrider/jobs/guard/scout_run.hpp"
#include "outrider/jobs/guard/supply_plan.hpp"
#include "outrider/jobs/guard/watch_run.hpp"
#include "pddl_task.hpp"
#include "regions_picture.hpp"
#include "summary.hpp"

namespace outrider {
namespace {

/// Whether the simulator that the scenario names is one that can carry it out.
Status check_sim(const GuardScenario& scenario) {
  if (scenario.sim == "kinematic") return {};
  if (scenario.sim != "physics") {
    return bad_input(fmt::format("'{}' is no good; it takes kinematic or physics", scenario.sim), "sim");
  }
  if (scenario.arrivals.any() || scenario.arrivals.leave < 1.0 || scenario.wander.any()) {
    return bad_input("physics guards a still yard; take kinematic where intruders come, walk or survive",
                     "sim");
  }
  return check_physics(scenario.problem);
}

/// The yard is still, or intruders come, or walk about, or those who are hit may survive.
Outcome<Report> carry_out(const GuardScenario& scenario, const Site& site, const GuardPlan& plan,
                          const RunWatch& watch) {
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  const GuardProblem& problem = scenario.problem;
  if (scenario.sim == "physics") {
    return run_guard_in_physics(problem, site, plan, scenario.options, seed, watch);
  }
  if (scenario.wander.any()) {
    return hunt(problem, site, scenario.preferences, scenario.history, scenario.wander, scenario.options,
                seed, watch);
  }
  const ArrivalOptions& arrivals = scenario.arrivals;
  if (arrivals.any()) {
    return keep_watch(problem, site, plan, scenario.intruders, arrivals, scenario.options, seed, watch);
  }
  if (arrivals.leave < 1.0) {
    return wear_down(problem, site, plan, arrivals, scenario.options, seed, watch);
  }
  return run_guard(problem, site, plan, scenario.options, seed, watch);
}

/// The exploring alone, which has pictures of its own.
Report exploring_of(Report report) {
  report.job = "explore";
  report.shots.clear();
  report.targets.clear();
  const double end_s = metric(report, "explore_s");
  std::erase_if(report.track, [&](const TrackSample& sample) { return sample.time_s > end_s; });
  std::erase_if(report.events, [&](const ReportEvent& event) { return event.time_s > end_s; });
  return report;
}

Run finished(Report report, double planning_s, const GuardScenario& scenario, const GuardProblem& problem,
             const Site& site) {
  report.machine_times.insert(report.machine_times.begin(), {"planning_s", planning_s});
  Run run{std::move(report)};
  if (run.report.explore) run.parts.push_back(exploring_of(run.report));
  if (scenario.regions) run.files.push_back({"firing_regions.svg", regions_svg(problem, site)});
  return run;
}

Outcome<Run> guard_known_yard(const GuardScenario& scenario, const GuardPlanner& planner,
                              const RunWatch& watch) {
  RunSteps steps(watch, 3);
  const double began_s = wall_s();
  if (auto ok = steps.next("surveying from where each target can be hit"); !ok) return pass_on(ok);
  auto site = survey(scenario.problem, scenario.options, watch.budget());
  if (!site) return pass_on(site);
  if (auto ok = steps.next("planning the tour"); !ok) return pass_on(ok);
  auto plan = scenario.wander.any() ? Outcome<GuardPlan>(GuardPlan{})
                                    : planner.plan(scenario.problem, *site, scenario.options, watch.budget());
  if (plan) plan = supply_plan(scenario.problem, *site, std::move(*plan), watch.budget());
  if (!plan) return pass_on(plan);
  if (scenario.options.shoot_on_the_move) plan = shoot_in_passing(scenario.problem, *site, *plan, watch.stop);
  const double planned_s = wall_s();
  if (auto ok = steps.next("driving and shooting"); !ok) return pass_on(ok);
  auto report = carry_out(scenario, *site, *plan, steps.inner());
  if (!report) return pass_on(report);
  if (report->sim) report->machine_times.emplace_back("physics_s", wall_s() - planned_s);
  return finished(std::move(*report), planned_s - began_s, scenario, scenario.problem, *site);
}

/// Plans and shoots on what was found.
Outcome<Run> guard_found_yard(const GuardScenario& scenario, const GuardPlanner& planner, ScoutedYard yard,
                              RunSteps& steps, const RunWatch& watch) {
  if (auto ok = steps.next("planning on the map found"); !ok) return pass_on(ok);
  const double began_s = wall_s();
  const GuardProblem found = yard.found.problem;
  const auto site = survey(found, scenario.options, watch.budget());
  if (!site) return tl::unexpected<Fault>(site.error());
  const auto plan = planner.plan(found, *site, scenario.options, watch.budget());
  if (!plan) return tl::unexpected<Fault>(plan.error());
  const double planning_s = wall_s() - began_s;
  if (auto ok = steps.next("driving and shooting"); !ok) return pass_on(ok);
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  auto report = run_guard_on_map(scenario.problem, std::move(yard), *site, *plan, scenario.options, seed,
                                 steps.inner());
  if (!report) return pass_on(report);
  return finished(std::move(*report), planning_s, scenario, found, *site);
}

/// The exploring comes first, and all plans are made on what it found. Whoever cancels the planning keeps
/// the exploring.
Outcome<Run> guard_unknown_yard(const GuardScenario& scenario, const GuardPlanner& planner,
                                const RunWatch& watch) {
  RunSteps steps(watch, 3);
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  if (auto ok = steps.next("exploring the yard"); !ok) return pass_on(ok);
  auto yard = scout(scenario.problem, {{}, scenario.sensors, scenario.scout}, seed, steps.inner());
  if (!yard) return pass_on(yard);
  Report explored = yard->run.report;
  explored.job = "guard";
  if (explored.status == "cancelled") return Run{std::move(explored)};
  auto run = guard_found_yard(scenario, planner, std::move(*yard), steps, watch);
  if (run || run.error().code != FaultCode::cancelled) return run;
  mark_cancelled(explored, metric(explored, "time_s"));
  return Run{std::move(explored)};
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
  if (auto ok = check_sim(scenario); !ok) return pass_on(ok);
  return warnings;
}

Outcome<Run> GuardJob::run(const RunWatch& watch) {
  if (scenario.pddl.any()) return run_pddl(scenario, watch);
  const auto planner = find_guard_planner(scenario.options.planner);
  return scenario.scout.unknown ? guard_unknown_yard(scenario, *planner, watch)
                                : guard_known_yard(scenario, *planner, watch);
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
          .summary = guard_summary,
          .tables = guard_tables};
}

}  // namespace outrider
