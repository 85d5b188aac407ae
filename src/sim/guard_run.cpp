#include "outrider/sim/guard_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "guard_scene.hpp"
#include "outrider/execute/guard_mission.hpp"
#include "outrider/sim/guard_robot.hpp"

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

}  // namespace

Report run_guard(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                 const GuardOptions& options, std::uint64_t seed) {
  SimulatedGuard robot(problem, site, seed);
  GuardMission mission = begin(problem, plan);
  double mission_s = 0.0;
  while (const auto command = step(mission, robot.sense(), problem, site)) {
    robot.act(*command);
    mission_s = robot.report.track.back().time_s;
  }

  Report report = std::move(robot.report);
  report.job = "guard";
  report.seed = seed;
  set_the_scene(report, problem, options);
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    report.targets.push_back(target_entry(problem.targets[t], mission.records[t], report));
  }
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
                    {"lower_bound_s", plan.lower_bound_s},
                    {"gap", plan.gap()},
                    {"driven_m", robot.driven_m},
                    {"turned_rad", robot.turned_rad},
                    {"shots", static_cast<double>(report.shots.size())},
                    {"stops", static_cast<double>(plan.stops.size())},
                    {"places", static_cast<double>(plan.places)}};
  return report;
}

}  // namespace outrider
