#include "team_job.hpp"

#include <fmt/format.h>

#include "outrider/core/units.hpp"
#include "outrider/job/clock.hpp"
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

}  // namespace

Status guard_with_team(const GuardScenario& scenario, Run& run, const RunWatch& watch) {
  RunSteps steps(watch, 3);
  const GuardProblem& problem = scenario.problem;
  const double began_s = wall_s();
  if (auto ok = steps.next("surveying from where each target can be hit"); !ok) return ok;
  const auto firing_map = build_firing_map(problem, scenario.options, watch.budget());
  if (!firing_map) return tl::unexpected<Fault>(firing_map.error());
  const auto starts =
      starts_of_team(problem, *firing_map, static_cast<std::size_t>(scenario.robots), scenario.other_starts);
  if (!starts) return tl::unexpected<Fault>(starts.error());
  if (scenario.regions) log_firing_regions(run.log, problem, *firing_map);
  log_starts(run.log, *starts, scenario.other_starts.empty());
  log_firing_map(run.log, *firing_map, 0.0);
  log_blocked_flights(run.log, problem, *firing_map, 0.0);
  if (auto ok = steps.next("planning the tours of the robots"); !ok) return ok;
  const auto plan = plan_team(problem, *firing_map, *starts, scenario.options, watch.budget());
  if (!plan) return tl::unexpected<Fault>(plan.error());
  const double planning_s = wall_s() - began_s;
  if (auto ok = steps.next("driving and shooting"); !ok) return ok;
  const TeamRun team = run_team(problem, *firing_map, *plan, static_cast<std::uint64_t>(scenario.seed),
                                steps.inner(), scenario.faults);
  append_team(run.log, team);
  run.report = judged_team(scenario, *firing_map, *plan, team, run.log);
  run.report.machine_times.emplace_back("planning_s", planning_s);
  if (team.ended_early || watch.stopped()) mark_cancelled(run.report, run.log, team.mission_s);
  return {};
}

}  // namespace outrider
