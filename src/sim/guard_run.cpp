#include "outrider/sim/guard_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/execute/guard_mission.hpp"
#include "outrider/sim/guard_robot.hpp"

namespace outrider {
namespace {

ReportSolid solid_entry(const Solid& solid, const World& world, const RobotModel& robot) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const Box3 box = bounds(solid);
  const double floor = world.floor_z_m;
  ReportSolid entry{solid.name,
                    std::string(kind(solid.shape)),
                    footprint(solid, -inf, inf),
                    box.low.z,
                    box.high.z,
                    !footprint(solid, floor + 1e-3, floor + robot.height_m).empty()};
  if (!std::isfinite(entry.low_z_m)) entry.low_z_m = floor;  // the ground
  if (!std::isfinite(entry.high_z_m)) entry.high_z_m = floor;
  return entry;
}

ReportTarget target_entry(const Target& target, const TargetRecord& record, const Report& report) {
  ReportTarget entry;
  entry.name = target.name;
  entry.status = to_string(record.status);
  entry.reason = record.reason;
  entry.centre = target.centre();
  entry.size = target.size;
  entry.yaw_rad = target.yaw_rad;
  entry.done_s = record.done_s;
  entry.shots = record.shots;
  entry.pose = record.pose;
  if (record.shot) {
    entry.pitch_rad = record.shot->shot.pitch_rad;
    entry.shot_yaw_rad = record.shot->shot.yaw_rad;
    entry.speed_mps = record.shot->shot.speed_mps;
    entry.clearance_m = record.shot->clearance_m;
  }
  for (const ReportShot& shot : report.shots) {
    if (shot.target == target.name && shot.hit) entry.clearance_m = shot.clearance_m;
  }
  return entry;
}

void set_the_scene(Report& report, const GuardProblem& problem, const GuardOptions& options) {
  report.world_name = problem.world.name;
  report.bounds = problem.world.bounds;
  report.gravity_mps2 = problem.world.gravity_mps2;
  report.robot_radius_m = problem.robot.radius_m;
  report.gun_length_m = std::hypot(problem.gun.tip_forward_m, problem.gun.tip_up_m);
  report.ball_radius_m = problem.gun.ball_radius_m;
  report.margin_m = options.margin_m;
  report.start = problem.start;
  for (const Solid& solid : problem.world.solids) {
    report.solids.push_back(solid_entry(solid, problem.world, problem.robot));
  }
}

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
                    {"driven_m", robot.driven_m},
                    {"turned_rad", robot.turned_rad},
                    {"shots", static_cast<double>(report.shots.size())},
                    {"stops", static_cast<double>(plan.stops.size())},
                    {"places", static_cast<double>(plan.places)}};
  return report;
}

}  // namespace outrider
