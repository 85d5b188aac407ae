#include "outrider/jobs/drive/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/report/world_scene.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

constexpr double belief_every_s = 0.2;
constexpr double look_around_m = 1.0;  ///< clearance beyond it is not told
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The way straight from waypoint to waypoint, and the turns from heading to heading where it stops.
struct Ideal {
  double driven_m = 0.0;
  double turned_rad = 0.0;
};
Ideal ideal_of(const DriveTask& task) {
  Ideal ideal;
  Vec2 from = task.start.position;
  double heading_rad = task.start.heading_rad;
  const bool turns_to_go = !task.closed_loop || task.follow.mode == "rotate_then_go";
  for (const Waypoint& waypoint : task.waypoints) {
    const Vec2 way = waypoint.pose.position - from;
    ideal.driven_m += norm(way);
    if (turns_to_go && norm(way) > 0.0) {
      ideal.turned_rad += std::abs(wrap_angle(heading_of(way) - heading_rad));
      heading_rad = heading_of(way);
    }
    if (waypoint.stop) {
      ideal.turned_rad += std::abs(wrap_angle(waypoint.pose.heading_rad - heading_rad));
      heading_rad = waypoint.pose.heading_rad;
    }
    from = waypoint.pose.position;
  }
  return ideal;
}

ReportCamera camera_entry(const TagEye& eye) {
  const Camera& lens = eye.camera;
  return {lens.width_px, lens.height_px, lens.fx, lens.fy, lens.cx, lens.cy, eye.ahead_m, eye.height_m};
}

/// Records the report while the robot drives.
class Recorder {
 public:
  Recorder(const DriveTask& task, const CollisionMap& ground, Report& report)
      : task_(task), ground_(ground), report_(report) {
    for (const Tag& tag : task.tags.tags) {
      report.drive->tags.push_back({tag.id, xy(tag.world_T_tag.position),
                                    heading_of(xy(-1.0 * tag.world_T_tag.rotation.axes[2])), tag.size_m,
                                    tag.world_T_tag.position.z});
    }
    if (task.closed_loop && !task.tags.tags.empty()) report.drive->camera = camera_entry(task.eye);
    for (const Waypoint& waypoint : task.waypoints) {
      report.drive->stops.push_back({waypoint.pose, waypoint.stop, nothing, {}, 0.0});
    }
  }

  /// After each step of the mission.
  void note(const DriveMission& mission, const SimulatedRobot& robot) {
    const Pose2& truth = robot.pose();
    const double time_s = robot.time_s();
    clearance_m = std::min(
        clearance_m, ground_.clearance(truth.position, task_.radius_m + look_around_m) - task_.radius_m);
    for (; arrivals_ < mission.arrivals.size(); ++arrivals_) arrived(mission.arrivals[arrivals_], truth);
    if (time_s < next_s_ && mission.end == DriveEnd::none) return;
    next_s_ = time_s + belief_every_s - 1e-9;
    report_.track.push_back({time_s, truth, 0.0, 0.0});
    const PoseBelief& belief = mission.reckoning.belief;
    const Eigen::Matrix3d& p = belief.covariance;
    const double x = std::sqrt(p(0, 0)), y = std::sqrt(p(1, 1));
    report_.drive->beliefs.push_back({mission.reckoning.time_s, belief.world_T_robot, x, y,
                                      x * y > 0.0 ? p(0, 1) / (x * y) : 0.0, heading_sigma_rad(belief),
                                      mission.used > used_});
    used_ = mission.used;
  }

  double clearance_m = look_around_m;

 private:
  void arrived(const DriveArrival& arrival, const Pose2& truth) {
    ReportStop& stop = report_.drive->stops[arrival.waypoint];
    stop.time_s = arrival.time_s;
    stop.error = truth.position - stop.pose.position;
    stop.heading_error_rad = wrap_angle(truth.heading_rad - stop.pose.heading_rad);
    report_.events.push_back(
        {arrival.time_s, "arrive",
         fmt::format("waypoint {} reached, {:.1f} mm and {:.2f} degrees off", arrival.waypoint + 1,
                     1e3 * norm(stop.error), degrees(stop.heading_error_rad))});
  }

  const DriveTask& task_;
  const CollisionMap& ground_;
  Report& report_;
  std::size_t arrivals_ = 0;
  std::int64_t used_ = 0;
  double next_s_ = 0.0;
};

Report opened(const DriveTask& task, std::uint64_t seed) {
  constexpr double any_m = std::numeric_limits<double>::infinity();  // all that stands is in its way
  Report report = world_scene("drive", seed, task.world, task.start, task.radius_m, any_m);
  report.drive.emplace();
  report.drive->loop = task.closed_loop ? "closed" : "open";
  return report;
}

void close(Report& report, const DriveMission& mission, const SimulatedRobot& robot, double clearance_m) {
  const DriveTask& task = mission.task;
  const Ideal ideal = ideal_of(task);
  const WheelBody& motion = robot.body<WheelBody>();
  const bool touched = clearance_m < 0.0;
  report.status = mission.end == DriveEnd::done && !touched ? "done" : "not_done";
  report.reason = mission.reason;
  if (report.reason.empty() && touched) {
    report.reason = fmt::format("the robot came {:.3f} m too near to an obstacle or the edge", -clearance_m);
  }
  if (mission.end != DriveEnd::done && mission.end != DriveEnd::none) {
    report.events.push_back(
        {mission.reckoning.time_s, mission.end == DriveEnd::lost ? "lost" : "stuck", mission.reason});
  }
  std::vector<Vec2> way = {task.start.position};
  for (const Waypoint& waypoint : task.waypoints) way.push_back(waypoint.pose.position);
  report.paths.push_back({0.0, motion.time_s(), std::move(way)});
  const double images = static_cast<double>(std::max<std::int64_t>(1, robot.devices().camera->images()));
  report.metrics = {{"driven_m", motion.driven_m()},
                    {"ideal_m", ideal.driven_m},
                    {"turned_rad", motion.turned_rad()},
                    {"ideal_rad", ideal.turned_rad},
                    {"tag_fraction", static_cast<double>(mission.used) / images},
                    {"time_s", mission.arrivals.empty() ? motion.time_s() : mission.arrivals.back().time_s},
                    {"clearance_m", clearance_m}};
}

/// In the open loop the camera is blind.
SimulatedRobot simulated_robot(const DriveTask& task, const DriveSimParams& params, bool rendered,
                               std::uint64_t seed) {
  const Rng rng(seed);
  TagCameraOptions options;
  options.rate_hz = task.eye.rate_hz;
  options.exposure_s = task.eye.exposure_s;
  TagSightFaults faults = params.sight;
  if (!task.closed_loop) faults.blind_from_s = 0.0;
  return SimulatedRobot(WheelBody(task.chassis, params.wheels, params.link, task.start, rng),
                        {.camera = SimulatedTagCamera({task.world, task.tags}, robot_camera(task.eye),
                                                      options, faults, rendered, rng)},
                        params.kidnapping);
}

}  // namespace

Report run_drive(const DriveTask& task, const DriveSimParams& params, bool rendered, std::uint64_t seed,
                 const RunWatch& watch) {
  Report report = opened(task, seed);
  const CollisionMap ground = CollisionMap::of(task.world, task.eye.height_m);
  SimulatedRobot robot = simulated_robot(task, params, rendered, seed);
  DriveMission mission = begin(task);
  Recorder recorder(task, ground, report);
  const bool finished = run_mission(mission, robot, watch.stop, [&](const Observation&, const Command*) {
    recorder.note(mission, robot);
    if (watch.wanted()) watch.show(report);
    watch.part(static_cast<double>(mission.arrivals.size()) / static_cast<double>(task.waypoints.size()));
  });
  watch.show(report);
  close(report, mission, robot, recorder.clearance_m);
  if (!finished) mark_cancelled(report, robot.time_s());
  return report;
}

std::vector<CalibrationRun> record_runs(const DriveTask& task, const DriveSimParams& params, int repeats,
                                        double sigma_m, double sigma_rad, std::uint64_t seed) {
  constexpr double coast_s = 2.0;
  constexpr double times_s[] = {1.0, 2.0, 3.0, 4.0, 5.0};
  const double speed = task.follow.speed_mps, turn_rate = task.follow.turn_rate_radps;
  std::vector<Twist2> commands = {{speed, 0.0, 0.0},  {-speed, 0.0, 0.0},    {0.0, speed, 0.0},
                                  {0.0, -speed, 0.0}, {0.0, 0.0, turn_rate}, {0.0, 0.0, -turn_rate}};
  if (!task.chassis.moves_sideways())
    std::erase_if(commands, [](const Twist2& u) { return u.left_mps != 0.0; });
  const Rng rng = Rng(seed).child("calibration");
  Rng measure = rng.child("measure");
  std::vector<CalibrationRun> runs;
  for (const Twist2& command : commands) {
    for (const double time_s : times_s) {
      for (int i = 0; i < repeats; ++i) {
        WheelBody motion(task.chassis, params.wheels, params.link, {}, rng.child(runs.size()));
        motion.send({});  // what the link loses
        motion.run_until(coast_s);
        motion.send(wheel_speeds(task.chassis, command));
        motion.run_until(coast_s + time_s);
        motion.send({});
        motion.run_until(coast_s + time_s + coast_s);
        Pose2 end = motion.pose();
        end.position = end.position + sigma_m * Vec2{measure.normal(), measure.normal()};
        end.heading_rad += sigma_rad * measure.normal();
        runs.push_back({command, time_s, end, {}});
      }
    }
  }
  return runs;
}

}  // namespace outrider
