#include "pddl_task.hpp"

#include <fmt/format.h>

#include "outrider/io/files.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/pddl.hpp"
#include "outrider/jobs/guard/temporal_mission.hpp"

namespace outrider {
namespace {

Outcome<TemporalMission> mission_of(const GuardScenario& scenario, const RunWatch& watch) {
  if (!scenario.has_still_targets()) {
    return bad_input("the PDDL problem is of a still yard; leave arrivals and wander out", "pddl");
  }
  GuardOptions options = scenario.options;
  options.shoot_on_the_move = false;  // its actions follow one another
  auto planner = find_guard_planner(options.planner);
  if (!planner) return pass_on(planner);
  RunSteps steps(watch, 3);
  if (auto ok = steps.next("surveying from where each target can be hit"); !ok) return pass_on(ok);
  auto firing_map = build_firing_map(scenario.problem, scenario.options, watch.budget());
  if (!firing_map) return pass_on(firing_map);
  if (auto ok = steps.next("planning the tour"); !ok) return pass_on(ok);
  auto plan = planner->plan(scenario.problem, *firing_map, options, watch.budget());
  if (!plan) return pass_on(plan);
  if (auto ok = steps.next("solving the tour of the stops offered"); !ok) return pass_on(ok);
  return temporal_mission(scenario.problem, *firing_map, *plan, options,
                          static_cast<std::size_t>(scenario.pddl.stops), watch.budget());
}

PddlNotes notes_of(const GuardProblem& problem, const TemporalMission& mission) {
  PddlNotes notes{problem.world.name, mission.places, {}, {}, {}};
  for (const std::size_t t : mission.targets) notes.targets.push_back(problem.targets[t].name);
  for (const std::size_t t : mission.left_out) notes.left_out.push_back(problem.targets[t].name);
  for (const StationCall& call : mission.calls) {
    notes.stations.push_back(problem.supplies.stations[call.station].name);
  }
  return notes;
}

Status write_problem(const GuardScenario& scenario, const TemporalMission& mission, Run& run) {
  const auto actions = temporal_actions(mission.problem, mission.steps);
  if (!actions) return tl::unexpected<Fault>(actions.error());
  const PddlNotes notes = notes_of(scenario.problem, mission);
  run.files = {{"domain.pddl", pddl_domain(mission.problem)},
               {"problem.pddl", pddl_problem(mission.problem, notes)},
               {"plan.txt", pddl_plan(mission.problem, *actions)}};
  const auto number = [](auto value) { return static_cast<double>(value); };
  run.report.metrics = {
      {"targets", number(mission.targets.size())},
      {"left_out", number(notes.left_out.size())},
      {"stops", number(mission.places.size())},
      {"poses", number(mission.problem.poses.size())},
      {"stations", number(mission.calls.size())},
      {"makespan_s", judge(mission.problem, *actions, scenario.pddl.tolerance_s).makespan_s},
      {"lower_bound_s", mission.lower_bound_s},
      {"proven", mission.proven ? 1.0 : 0.0}};
  for (const std::string& name : notes.left_out)
    run.report.warnings.push_back(fmt::format("{} is left out; nothing hits it", name));
  return {};
}

Status judge_plan(const GuardScenario& scenario, const TemporalMission& mission, const std::string& text,
                  Run& run) {
  const auto plan = pddl_plan_from_text(text, scenario.pddl.validate, mission.problem);
  if (!plan) return tl::unexpected<Fault>(plan.error());
  const TemporalVerdict verdict = judge(mission.problem, plan->actions, scenario.pddl.tolerance_s);
  if (!verdict.valid()) {
    run.report.status = "not_done";
    run.report.reason = verdict.reason;
    if (verdict.broken) {
      run.report.reason = fmt::format("{}:{}: {}: {}", scenario.pddl.validate, plan->lines[*verdict.broken],
                                      plan->phrases[*verdict.broken], verdict.reason);
    }
  }
  run.report.metrics = {{"actions", static_cast<double>(plan->actions.size())},
                        {"makespan_s", verdict.makespan_s},
                        {"our_makespan_s", mission.cost_s},
                        {"lower_bound_s", mission.lower_bound_s}};
  return {};
}

}  // namespace

Status run_pddl(const GuardScenario& scenario, Run& run, const RunWatch& watch) {
  std::string text;
  if (!scenario.pddl.validate.empty()) {
    auto read = read_file(scenario.pddl.validate);
    if (!read) return tl::unexpected<Fault>(read.error());
    text = std::move(*read);
  }
  const auto mission = mission_of(scenario, watch);
  if (!mission) return tl::unexpected<Fault>(mission.error());
  run.report.status = "done";
  run.report.world_name = scenario.problem.world.name;
  return scenario.pddl.validate.empty() ? write_problem(scenario, *mission, run)
                                        : judge_plan(scenario, *mission, text, run);
}

}  // namespace outrider
