#include "team_job.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/job/plan_cache.hpp"
#include "outrider/jobs/guard/team_starts.hpp"
#include "outrider/log/append.hpp"
#include "regions_log.hpp"
#include "team_log.hpp"

namespace outrider {
namespace {

void log_starts(Log& log, const std::vector<Pose2>& starts, bool chosen) {
  for (std::size_t r = 1; r < starts.size(); ++r) {
    const auto& [place, heading_rad] = starts[r];
    log_event(log, 0.0, "start",
              fmt::format("robot {} starts at ({:.2f}, {:.2f}), {:.0f} degrees{}", r + 1, place.x, place.y,
                          degrees(heading_rad), chosen ? ", chosen beside robot 1" : ""));
  }
}

void log_survey(Log& log, const GuardScenario& scenario, const FiringMap& firing_map,
                const std::vector<Pose2>& starts) {
  if (scenario.regions) log_firing_regions(log, scenario.problem, firing_map);
  log_starts(log, starts, scenario.other_starts.empty());
  log_firing_map(log, firing_map, 0.0);
  log_blocked_flights(log, scenario.problem, firing_map, 0.0);
}

/// What is planned of a yard for a team.
struct TeamYardPlan {
  FiringMap firing_map;
  std::vector<Pose2> starts;
  TeamPlan plan;
};

Outcome<std::shared_ptr<const TeamYardPlan>> plan_yard(const GuardScenario& scenario, const std::string& key,
                                                       RunSteps& steps, const RunWatch& watch, Log& log) {
  const GuardProblem& problem = scenario.problem;
  if (auto ok = steps.next("surveying from where each target can be hit"); !ok) return pass_on(ok);
  if (auto planned = find_plan<TeamYardPlan>(watch.plans, key); planned) {
    log_survey(log, scenario, planned->firing_map, planned->starts);
    if (auto ok = steps.next("planning the tours of the robots"); !ok) return pass_on(ok);
    return planned;
  }
  auto firing_map = build_firing_map(problem, scenario.options, watch.budget());
  if (!firing_map) return pass_on(firing_map);
  auto starts =
      starts_of_team(problem, *firing_map, static_cast<std::size_t>(scenario.robots), scenario.other_starts);
  if (!starts) return pass_on(starts);
  log_survey(log, scenario, *firing_map, *starts);
  if (auto ok = steps.next("planning the tours of the robots"); !ok) return pass_on(ok);
  auto plan = plan_team(problem, *firing_map, *starts, scenario.options, watch.budget());
  if (!plan) return pass_on(plan);
  return keep_plan(watch.plans, key,
                   TeamYardPlan{std::move(*firing_map), std::move(*starts), std::move(*plan)});
}

}  // namespace

Status guard_with_team(const GuardScenario& scenario, const std::string& key, Run& run,
                       const RunWatch& watch) {
  RunSteps steps(watch, 3);
  const double began_s = wall_s();
  const auto yard = plan_yard(scenario, key, steps, watch, run.log);
  if (!yard) return tl::unexpected<Fault>(yard.error());
  const auto& [firing_map, starts, plan] = **yard;
  const double planning_s = wall_s() - began_s;
  if (auto ok = steps.next("driving and shooting"); !ok) return ok;
  const TeamRun team = run_team(scenario.problem, firing_map, plan, static_cast<std::uint64_t>(scenario.seed),
                                steps.inner(), scenario.faults);
  append_team(run.log, team);
  run.report = judged_team(scenario, firing_map, plan, team, run.log);
  run.report.machine_times.emplace_back("planning_s", planning_s);
  if (team.ended_early || watch.stopped()) mark_cancelled(run.report, run.log, team.mission_s);
  return {};
}

}  // namespace outrider
