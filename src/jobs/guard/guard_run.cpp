#include "outrider/jobs/guard/guard_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "guard_scene.hpp"
#include "outrider/jobs/guard/guard_robot.hpp"
#include "outrider/jobs/guard/supply_mission.hpp"

namespace outrider {
namespace {

double count(const Report& report, std::string_view status) {
  return static_cast<double>(std::count_if(report.targets.begin(), report.targets.end(),
                                           [&](const ReportTarget& t) { return t.status == status; }));
}

/// Targets that the reference's rule would have counted, whatever ours says.
double reached_by_reference_rule(const Report& report) {
  return static_cast<double>(
      std::count_if(report.targets.begin(), report.targets.end(), [&](const ReportTarget& t) {
        return std::any_of(report.shots.begin(), report.shots.end(), [&](const ReportShot& s) {
          return s.target == t.name && s.hit_by_reference_rule;
        });
      }));
}

/// How often a store was filled, and how low it was at least.
void add_supply_metrics(Report& report, const SupplyMission& mission) {
  const auto fills = std::count_if(report.events.begin(), report.events.end(),
                                   [](const ReportEvent& event) { return event.kind == "fill"; });
  report.metrics.emplace_back("fills", static_cast<double>(fills));
  report.metrics.emplace_back("unplanned_fills", static_cast<double>(mission.detours));
  double water = report.supplies->tank;
  double charge_j = report.supplies->battery_j;
  for (const ReportLevel& level : report.supplies->levels) {
    water = std::min(water, level.water);
    charge_j = std::min(charge_j, level.charge_j);
  }
  if (std::isfinite(water)) report.metrics.emplace_back("least_water", water);
  if (std::isfinite(charge_j)) report.metrics.emplace_back("least_charge_j", charge_j);
}

/// How many shots left while the robot drove, and how many of them hit.
void add_passing_metrics(Report& report) {
  const auto passing = [](const ReportShot& shot) { return shot.platform_velocity_mps.has_value(); };
  const auto hits = [&](const ReportShot& shot) { return passing(shot) && shot.hit; };
  report.metrics.emplace_back("shots_in_passing",
                              static_cast<double>(std::ranges::count_if(report.shots, passing)));
  report.metrics.emplace_back("hits_in_passing",
                              static_cast<double>(std::ranges::count_if(report.shots, hits)));
}

}  // namespace

Report guard_report(GuardDeeds deeds, const GuardMission& mission, const GuardProblem& problem,
                    const GuardPlan& plan) {
  Report report = std::move(deeds.report);
  const double mission_s = report.track.empty() ? 0.0 : report.track.back().time_s;
  list_targets(report, problem, mission);
  const auto targets = static_cast<double>(problem.targets.size());
  const double reached = count(report, "reached");
  const double failed = count(report, "failed");
  report.status = failed == 0.0 ? "done" : "not_done";
  if (reached < targets) {
    report.reason = fmt::format("{} of {} targets reached, {} failed, {} proven to be out of reach", reached,
                                targets, failed, targets - reached - failed);
  }
  report.metrics = {{"targets", targets},
                    {"reached", reached},
                    {"failed", count(report, "failed")},
                    {"unreachable", count(report, "unreachable")},
                    {"reached_by_reference_rule", reached_by_reference_rule(report)},
                    {"mission_s", mission_s},
                    {"planned_s", plan.cost_s},
                    {"expected_s", plan.bounded_s()},
                    {"lower_bound_s", plan.lower_bound_s},
                    {"gap", plan.gap()},
                    {"anywhere_lower_bound_s", plan.anywhere_lower_bound_s},
                    {"anywhere_gap", plan.anywhere_gap()},
                    {"tour_proven", plan.tour_proven ? 1.0 : 0.0},
                    {"stops_offered", static_cast<double>(plan.stops_offered)},
                    {"driven_m", deeds.driven_m},
                    {"turned_rad", deeds.turned_rad},
                    {"shots", static_cast<double>(report.shots.size())},
                    {"stops", static_cast<double>(plan.stops.size())},
                    {"places", static_cast<double>(plan.places)}};
  return report;
}

Report run_guard(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                 const GuardOptions& options, std::uint64_t seed, const RunWatch& watch) {
  SimulatedGuard robot(problem, site, seed);
  set_the_scene(robot.report, problem, options, seed);
  SupplyMission mission = begin_supplied(problem, plan);
  mission.guard.stop = watch.stop;
  const auto show = [&] {
    list_targets(robot.report, problem, mission.guard);
    watch.show(robot.report);
  };
  bool stopped = false;
  while (const auto command = step(mission, robot.sense(), problem, site)) {
    if (watch.wanted()) show();
    if ((stopped = watch.stopped())) break;
    robot.act(*command);
  }
  stopped = stopped || watch.stopped();
  if (watch.observer != nullptr) show();
  Report report =
      guard_report({std::move(robot.report), robot.driven_m, robot.turned_rad}, mission.guard, problem, plan);
  if (problem.supplies.any()) add_supply_metrics(report, mission);
  if (options.shoot_on_the_move) add_passing_metrics(report);
  if (stopped) mark_cancelled(report, report.track.back().time_s);
  return report;
}

}  // namespace outrider
