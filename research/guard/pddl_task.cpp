#include "research/guard/pddl_task.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/jobs/guard/capabilities.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "research/guard/pddl.hpp"
#include "research/guard/temporal_mission.hpp"

namespace outrider {
namespace {

Outcome<TemporalMission> mission_of(const GuardScenario& scenario, const PddlOptions& pddl,
                                    const RunWatch& watch) {
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
  return temporal_mission(scenario.problem, *firing_map, *plan, options, static_cast<std::size_t>(pddl.stops),
                          watch.budget());
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

Status write_problem(const GuardScenario& scenario, const PddlOptions& pddl, const TemporalMission& mission,
                     Run& run) {
  const auto actions = temporal_actions(mission.problem, mission.steps);
  if (!actions) return pass_on(actions);
  const PddlNotes notes = notes_of(scenario.problem, mission);
  run.files = {{"domain.pddl", pddl_domain(mission.problem)},
               {"problem.pddl", pddl_problem(mission.problem, notes)},
               {"plan.txt", pddl_plan(mission.problem, *actions)}};
  const auto number = [](auto value) { return static_cast<double>(value); };
  run.report.metrics = {{"targets", number(mission.targets.size())},
                        {"left_out", number(notes.left_out.size())},
                        {"stops", number(mission.places.size())},
                        {"poses", number(mission.problem.poses.size())},
                        {"stations", number(mission.calls.size())},
                        {"makespan_s", judge(mission.problem, *actions, pddl.tolerance_s).makespan_s},
                        {"lower_bound_s", mission.lower_bound_s},
                        {"proven", mission.proven ? 1.0 : 0.0}};
  for (const std::string& name : notes.left_out)
    run.report.warnings.push_back(fmt::format("{} is left out; nothing hits it", name));
  return {};
}

Status judge_plan(const PddlOptions& pddl, const TemporalMission& mission, const std::string& text,
                  Run& run) {
  const auto plan = pddl_plan_from_text(text, pddl.validate, mission.problem);
  if (!plan) return pass_on(plan);
  const TemporalVerdict verdict = judge(mission.problem, plan->actions, pddl.tolerance_s);
  if (!verdict.valid()) {
    run.report.status = "not_done";
    run.report.reason = verdict.reason;
    if (verdict.broken) {
      run.report.reason = fmt::format("{}:{}: {}: {}", pddl.validate, plan->lines[*verdict.broken],
                                      plan->phrases[*verdict.broken], verdict.reason);
    }
  }
  run.report.metrics = {{"actions", static_cast<double>(plan->actions.size())},
                        {"makespan_s", verdict.makespan_s},
                        {"our_makespan_s", mission.cost_s},
                        {"lower_bound_s", mission.lower_bound_s}};
  return {};
}

/// Fault: the first capability of the scenario that the problem does not have.
Status check_still_yard(const GuardScenario& scenario) {
  using enum Capability;
  for (const Capability one : requested_capabilities(scenario)) {
    if (one != arrivals && one != survivors && one != walkers && one != team) continue;
    const CapabilityRow& row = capabilities()[static_cast<std::size_t>(one)];
    return bad_input(
        fmt::format("{} and a problem in PDDL do not go together, because it is that of one robot in a still "
                    "yard; leave out {} or pddl",
                    row.noun, row.key),
        "pddl");
  }
  return {};
}

class PddlGuardJob final : public GuardJob {
 public:
  Outcome<Warnings> load() override {
    if (pddl_.write && !pddl_.validate.empty()) {
      return bad_input(
          "a problem is written or a plan is judged; leave one of pddl.write and pddl.validate out",
          "pddl.validate");
    }
    auto warnings = GuardJob::load();
    if (!warnings || !pddl_.any()) return warnings;
    if (auto ok = check_still_yard(scenario); !ok) return pass_on(ok);
    return warnings;
  }
  Status run(Run& run, const RunWatch& watch) override {
    return pddl_.any() ? run_pddl(scenario, pddl_, run, watch) : GuardJob::run(run, watch);
  }

 protected:
  std::vector<OptionGroup> describe() override {
    std::vector<OptionGroup> groups = GuardJob::describe();
    groups.push_back(
        {"pddl", "the decision problem as PDDL 2.1, in place of a mission", outrider::describe(pddl_)});
    return groups;
  }

 private:
  PddlOptions pddl_;
};

/// Returns the text for a problem that was written as PDDL, or a plan that was judged, in place of a mission.
std::string pddl_summary(const Report& report) {
  const double makespan_s = metric(report, "makespan_s");
  if (!std::isnan(metric(report, "our_makespan_s"))) {
    if (report.status != "done") return fmt::format("invalid: {}\n", printable(report.reason));
    return fmt::format("valid: {:.0f} actions, makespan {:.6f} s; ours takes {:.6f} s\n",
                       metric(report, "actions"), makespan_s, metric(report, "our_makespan_s"));
  }
  const double bound_s = metric(report, "lower_bound_s");
  return fmt::format(
      "{}: {:.0f} targets, {:.0f} stops, {:.0f} poses, {:.0f} stations\n"
      "  our plan takes {:.6f} s; {}\n",
      printable(report.world_name), metric(report, "targets"), metric(report, "stops"),
      metric(report, "poses"), metric(report, "stations"), makespan_s,
      bound_s > 0.0 ? fmt::format("no plan takes less than {:.6f} s", bound_s)
                    : std::string("how much less another plan takes is not known"));
}

}  // namespace

std::vector<Option> describe(PddlOptions& options) {
  return {{"write", "", 0, 0, "write the problem, and our plan, to the folder of --out; no mission",
           &options.write},
          {"stops", "", 0, 300, "places beside those of our plan that the problem offers", &options.stops},
          file_option("validate", "judge this plan for the problem of the same options; no mission",
                      &options.validate),
          {"tolerance", "s", 0, 0.1, "by which times of that plan may be off", &options.tolerance_s}};
}

Status run_pddl(const GuardScenario& scenario, const PddlOptions& pddl, Run& run, const RunWatch& watch) {
  std::string text;
  if (!pddl.validate.empty()) {
    auto read = read_file(pddl.validate);
    if (!read) return pass_on(read);
    text = std::move(*read);
  }
  const auto mission = mission_of(scenario, pddl, watch);
  if (!mission) return pass_on(mission);
  run.report.status = "done";
  run.report.world_name = scenario.problem.world.name;
  return pddl.validate.empty() ? write_problem(scenario, pddl, *mission, run)
                               : judge_plan(pddl, *mission, text, run);
}

Job guard_job_with_pddl() {
  Job job = guard_job();
  job.blank = [] { return std::make_unique<PddlGuardJob>(); };
  job.aliases.insert(
      job.aliases.end(),
      {{"pddl", "pddl.write"}, {"validate", "pddl.validate"}, {"validate-tolerance", "pddl.tolerance"}});
  job.summary = [guarded = job.summary](const Report& report) {
    return std::isnan(metric(report, "mission_s")) ? pddl_summary(report) : guarded(report);
  };
  return job;
}

}  // namespace outrider
