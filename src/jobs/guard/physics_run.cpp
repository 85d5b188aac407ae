#include "outrider/jobs/guard/physics_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "guard_scene.hpp"
#include "outrider/jobs/guard/guard_mission.hpp"
#include "outrider/jobs/guard/physics_robot.hpp"

namespace outrider {
namespace {

// Ways may pass obstacles as near as the disk, and the wheels are a little off them: the robot of rigid
// bodies is 0.9 times as large, and may find new ways from half of the room between.
constexpr double way_radius = 0.95;

double part_settled(const GuardMission& mission) {
  const auto waiting = std::ranges::count(mission.records, TargetStatus::waiting, &TargetRecord::status);
  return 1.0 - static_cast<double>(waiting) / static_cast<double>(mission.records.size());
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double most(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

}  // namespace

Status check_physics(const GuardProblem& problem) {
  const auto refuse = [](const std::string& what) {
    return bad_input(fmt::format("physics knows no {}; leave it out, or take kinematic", what), "sim");
  };
  if (!problem.air.none()) return refuse("air");
  if (problem.supplies.any()) return refuse("tank and no battery that ends");
  if (problem.world.terrain) return refuse("terrain");
  if (auto bodies = make_rigid_world(problem); !bodies) return pass_on(bodies);
  return {};
}

Outcome<Report> run_guard_in_physics(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                                     const GuardOptions& options, std::uint64_t seed, const RunWatch& watch) {
  if (auto ok = check_physics(problem); !ok) return pass_on(ok);
  auto bodies = make_rigid_world(problem);
  if (!bodies) return pass_on(bodies);
  PhysicsGuard robot(problem, site, **bodies, seed);
  set_the_scene(robot.report, problem, options, seed);
  robot.report.sim = "physics";
  GuardMission mission = begin(problem, plan);
  mission.stop = watch.stop;
  GuardProblem yielding = problem;
  yielding.robot.radius_m *= way_radius;
  const auto show = [&] {
    list_targets(robot.report, problem, mission);
    watch.show(robot.report);
  };
  bool stopped = false;
  while (const auto command = step(mission, robot.sense(), yielding, site)) {
    if (watch.wanted()) show();
    if ((stopped = watch.stopped())) break;
    robot.act(*command);
    watch.part(part_settled(mission));
  }
  stopped = stopped || watch.stopped();
  watch.part(1.0);
  if (watch.observer != nullptr) show();
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    TargetRecord& record = mission.records[t];
    if (record.status != TargetStatus::failed || robot.misses[t].empty()) continue;
    record.reason += fmt::format("; the last shot {}", robot.misses[t]);
  }

  Report report =
      guard_report({std::move(robot.report), robot.driven_m, robot.turned_rad}, mission, problem, plan);
  report.metrics.insert(report.metrics.end(), {{"arrival_error_mean_m", mean(robot.arrival_errors_m)},
                                               {"arrival_error_max_m", most(robot.arrival_errors_m)},
                                               {"flight_error_max_m", robot.flight_error_m},
                                               {"shots_as_foreseen", static_cast<double>(robot.foreseen)},
                                               {"bumps", static_cast<double>(robot.bumps)}});
  if (stopped) mark_cancelled(report, report.track.back().time_s);
  return report;
}

}  // namespace outrider
