#include "guard_scene.hpp"

#include <cmath>
#include <limits>

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

}  // namespace

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

}  // namespace outrider
