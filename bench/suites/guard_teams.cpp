#include "guard_teams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "outrider/jobs/guard/team/team_plan.hpp"
#include "outrider/jobs/guard/team/team_run.hpp"
#include "outrider/motion/closest_approach.hpp"
#include "rows.hpp"
#include "stopwatch.hpp"

namespace outrider::bench {
namespace {

double number_of(const std::vector<TargetRecord>& records, TargetStatus status) {
  return static_cast<double>(std::ranges::count(records, status, &TargetRecord::status));
}

/// Adds the runs of a plan to its row.
void simulate(const GuardScenario& yard, const FiringMap& firing_map, const TeamPlan& plan, TeamRow& row) {
  row.closest_m = std::numeric_limits<double>::infinity();
  const double share = 1.0 / static_cast<double>(row.runs);
  for (std::int64_t seed = 1; seed <= row.runs; ++seed) {
    const TeamRun run = run_team(yard.problem, firing_map, plan, static_cast<std::uint64_t>(seed));
    row.reached += share * number_of(run.records, TargetStatus::reached);
    row.failed += share * number_of(run.records, TargetStatus::failed);
    row.mission_s += share * run.mission_s;
    row.waited_s += share * run.waited_s;
    std::vector<TimedDrives> driven;
    for (const TeamRobotRun& robot : run.robots) driven.push_back(robot.driven);
    row.closest_m = std::min(row.closest_m, closest_approach(yard.problem.robot, driven).value().distance_m);
  }
}

Outcome<TeamRow> measure_team(const GuardScenario& yard, std::int64_t robots, std::int64_t seeds) {
  const Stopwatch watch;
  auto firing_map = build_firing_map(yard.problem, yard.options);
  if (!firing_map) return pass_on(firing_map);
  auto starts = starts_of_team(yard.problem, *firing_map, static_cast<std::size_t>(robots), {});
  if (!starts) return pass_on(starts);
  TeamPlan plan;
  if (robots == 1) {
    auto alone = plan_guard(yard.problem, *firing_map, yard.options, {});
    if (!alone) return pass_on(alone);
    plan.unreachable = alone->unreachable;
    plan.makespan_s = plan.alone_s = alone->cost_s;
    plan.lower_bound_s = alone->lower_bound_s;
    plan.parts.push_back({yard.problem.start, std::move(*alone), {{}, {}, plan.makespan_s}});
  } else {
    auto team = plan_team(yard.problem, *firing_map, *starts, yard.options, {});
    if (!team) return pass_on(team);
    plan = std::move(*team);
  }
  TeamRow row;
  row.yard = std::filesystem::path(yard.world).stem().string();
  row.robots = robots;
  row.runs = seeds;
  row.planning_s = watch.seconds();
  row.planned_s = plan.makespan_s;
  row.lower_bound_s = plan.lower_bound_s;
  row.ratio = plan.alone_s > 0.0 ? plan.makespan_s / plan.alone_s : 1.0;
  simulate(yard, *firing_map, plan, row);
  return row;
}

}  // namespace

Outcome<std::vector<TeamRow>> measure_teams(const std::vector<GuardScenario>& yards, std::int64_t robots,
                                            std::int64_t seeds, const BenchObserver& observer) {
  begin_steps(observer, yards.size() * static_cast<std::size_t>(robots));
  std::vector<TeamRow> rows;
  for (const GuardScenario& yard : yards) {
    for (std::int64_t number = 1; number <= robots; ++number) {
      next_step(observer, fmt::format("{} robots in {}", number, yard.problem.world.name));
      auto row = measure_team(yard, number, seeds);
      if (!row) return pass_on(row);
      rows.push_back(std::move(*row));
    }
  }
  return rows;
}

std::string teams_table(const std::vector<TeamRow>& rows) {
  std::string text =
      fmt::format("  {:<12} {:>6} {:>4} {:>7} {:>6} {:>10} {:>9} {:>9} {:>7} {:>8} {:>9} {:>5}\n", "yard",
                  "robots", "runs", "reached", "failed", "planning s", "planned s", "mission s", "bound s",
                  "waited s", "closest m", "ratio");
  for (const TeamRow& row : rows) {
    text += fmt::format(
        "  {:<12} {:>6} {:>4} {:>7.1f} {:>6.1f} {:>10.2f} {:>9.1f} {:>9.1f} {:>7.1f} {:>8.1f} {:>9} "
        "{:>5.2f}\n",
        row.yard, row.robots, row.runs, row.reached, row.failed, row.planning_s, row.planned_s, row.mission_s,
        row.lower_bound_s, row.waited_s,
        std::isfinite(row.closest_m) ? fmt::format("{:.2f}", row.closest_m) : std::string("-"), row.ratio);
  }
  return text;
}

nlohmann::ordered_json teams_json(const std::vector<TeamRow>& rows) {
  auto list = nlohmann::ordered_json::array();
  for (const TeamRow& row : rows) {
    list.push_back(
        {{"yard", row.yard},
         {"robots", row.robots},
         {"runs", row.runs},
         {"reached", row.reached},
         {"failed", row.failed},
         {"planning_s", row.planning_s},
         {"planned_s", row.planned_s},
         {"mission_s", row.mission_s},
         {"lower_bound_s", row.lower_bound_s},
         {"waited_s", row.waited_s},
         {"closest_m", std::isfinite(row.closest_m) ? nlohmann::ordered_json(row.closest_m) : nullptr},
         {"ratio_to_one_robot", row.ratio}});
  }
  return list;
}

}  // namespace outrider::bench
