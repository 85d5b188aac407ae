#include "pddl.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/pddl.hpp"
#include "outrider/jobs/guard/temporal_mission.hpp"
#include "progress.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

Outcome<TemporalMission> mission_of(const PddlRequest& request, const GuardScenario& scenario) {
  if (scenario.arrivals.any() || scenario.arrivals.leave < 1.0 || scenario.wander.any()) {
    return bad_input("the PDDL problem is of a still yard; leave arrivals and wander out",
                     request.plan.empty() ? "--pddl" : "--validate");
  }
  auto planner = find_guard_planner(scenario.options.planner);
  if (!planner) return pass_on(planner);
  Progress progress(3);
  progress.next("surveying from where each target can be hit");
  auto site = survey(scenario.problem, scenario.options);
  if (!site) return pass_on(site);
  progress.next("planning the tour");
  auto plan = planner->plan(scenario.problem, *site, scenario.options, {});
  if (!plan) return pass_on(plan);
  progress.next("solving the tour of the stops offered");
  return temporal_mission(scenario.problem, *site, *plan, scenario.options,
                          static_cast<std::size_t>(request.stops), {});
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

int write_problem(const PddlRequest& request, const GuardScenario& scenario, const TemporalMission& mission,
                  const std::vector<std::string>& warnings, bool json) {
  const auto actions = temporal_actions(mission.problem, mission.steps);
  if (!actions) return say(actions.error(), json);
  const PddlNotes notes = notes_of(scenario.problem, mission);
  const std::string stem = request.folder + "/";
  const std::vector<NamedText> files = {{"domain.pddl", pddl_domain(mission.problem)},
                                        {"problem.pddl", pddl_problem(mission.problem, notes)},
                                        {"plan.txt", pddl_plan(mission.problem, *actions)}};
  if (auto ok = write_files(request.folder, files); !ok) return say(ok.error(), json);
  const double makespan_s = judge(mission.problem, *actions, request.tolerance_s).makespan_s;
  if (json) {
    print(Json{{"status", "done"},
               {"job", "guard"},
               {"domain", stem + "domain.pddl"},
               {"problem", stem + "problem.pddl"},
               {"plan", stem + "plan.txt"},
               {"targets", mission.targets.size()},
               {"left_out", notes.left_out},
               {"stops", mission.places.size()},
               {"poses", mission.problem.poses.size()},
               {"stations", mission.calls.size()},
               {"makespan_s", makespan_s},
               {"lower_bound_s", mission.lower_bound_s},
               {"proven", mission.proven},
               {"warnings", warnings}});
    return job_done;
  }
  show("{}: {} targets, {} stops, {} poses{}\n\n  domain   {}domain.pddl\n  problem  {}problem.pddl\n",
       scenario.problem.world.name, mission.targets.size(), mission.places.size(),
       mission.problem.poses.size(),
       scenario.problem.supplies.any() ? "" : "; supplies have no end, so there are no stations", stem, stem);
  for (const std::string& name : notes.left_out) show("  left out {}, which nothing hits\n", name);
  show("  plan     {}plan.txt takes {:.6f} s; {}\n", stem, makespan_s,
       mission.proven ? "no plan takes less"
                      : fmt::format("no plan takes less than {:.6f} s", mission.lower_bound_s));
  return job_done;
}

int judge_plan(const PddlRequest& request, const TemporalMission& mission, const std::string& text,
               const std::vector<std::string>& warnings, bool json) {
  const auto plan = pddl_plan_from_text(text, request.plan, mission.problem);
  if (!plan) return say(plan.error(), json);
  const TemporalVerdict verdict = judge(mission.problem, plan->actions, request.tolerance_s);
  std::string broken = verdict.reason;
  if (verdict.broken) {
    broken = fmt::format("{}:{}: {}: {}", request.plan, plan->lines[*verdict.broken],
                         plan->phrases[*verdict.broken], verdict.reason);
  }
  if (json) {
    print(Json{{"status", verdict.valid() ? "done" : "not_done"},
               {"job", "guard"},
               {"valid", verdict.valid()},
               {"makespan_s", verdict.makespan_s},
               {"broken", verdict.valid() ? Json(nullptr) : Json(broken)},
               {"actions", plan->actions.size()},
               {"our_makespan_s", mission.cost_s},
               {"lower_bound_s", mission.lower_bound_s},
               {"warnings", warnings}});
  } else if (verdict.valid()) {
    show("valid: {} actions, makespan {:.6f} s; ours takes {:.6f} s\n", plan->actions.size(),
         verdict.makespan_s, mission.cost_s);
  } else {
    show("invalid: {}\n", broken);
  }
  return verdict.valid() ? job_done : job_not_done;
}

}  // namespace

std::vector<Option> describe(PddlRequest& request) {
  return {
      {"pddl", "", 0, 0, "write the decision problem as PDDL 2.1, and our plan, to this folder; no mission",
       &request.folder},
      {"pddl_stops", "", 0, 300, "places beside those of our plan that the PDDL problem offers",
       &request.stops},
      {"validate", "", 0, 0, "judge a plan for the PDDL problem of the same scenario and flags; no mission",
       &request.plan},
      {"validate_tolerance", "s", 0, 0.1, "by which times of that plan may be off", &request.tolerance_s}};
}

Status check(const PddlRequest& request, const Command& flags) {
  const auto given = [&](const char* flag) { return flags.given(flag); };
  if (given("--pddl") && given("--validate")) {
    return bad_input("a problem is written or a plan is judged; leave one of --pddl and --validate out",
                     "--validate");
  }
  if (given("--validate") && request.plan.empty()) return bad_input("the file name is empty", "--validate");
  if (given("--pddl")) {
    if (auto ok = check_folder(request.folder); !ok) return bad_input(ok.error().sentence, "--pddl");
  }
  for (const char* flag : {"--out", "--html", "--svg", "--regions"}) {
    if (!request.any() || !given(flag)) continue;
    return bad_input(fmt::format("{} carries out no mission; leave {} out",
                                 given("--pddl") ? "--pddl" : "--validate", flag),
                     flag);
  }
  return {};
}

int carry_out(const PddlRequest& request, const GuardScenario& scenario,
              const std::vector<std::string>& warnings, bool json) {
  std::string text;
  if (!request.plan.empty()) {
    auto read = read_file(request.plan);
    if (!read) return say(read.error(), json);
    text = std::move(*read);
  }
  const auto mission = mission_of(request, scenario);
  if (!mission) return say(mission.error(), json);
  return request.plan.empty() ? write_problem(request, scenario, *mission, warnings, json)
                              : judge_plan(request, *mission, text, warnings, json);
}

}  // namespace outrider::cli
