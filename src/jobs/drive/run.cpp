#include "outrider/jobs/drive/run.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/robot/steady_time.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

constexpr double belief_every_s = 0.2;
constexpr double look_around_m = 1.0;  ///< beyond the radius: more clearance is not told
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool turns_to_go(const DriveTask& task) { return !task.closed_loop || task.follow.mode == "rotate_then_go"; }

/// Returns the least time on the way with rounded corners.
double ideal_s(const DriveTask& task) {
  FollowOptions follow = task.follow;
  if (turns_to_go(task)) follow.mode = "rotate_then_go";
  const double pause_s = task.closed_loop ? task.rules.settle_s : task.rules.rest_s;
  return ideal_time_s(task.start, task.waypoints, follow, task.chassis, pause_s);
}
/// Logs the drive.
class Recorder {
 public:
  Recorder(const DriveTask& task, const CollisionMap& ground, Log& log)
      : task_(task),
        ground_(ground),
        log_(log),
        waypoints_(waypoints_message(task)),
        outcomes_(task.waypoints.size(), "not reached"),
        nearest_m_(task.waypoints.size(), unknown) {
    clearance_m = task.radius_m + look_around_m;
    log.append(topic::waypoints, 0.0, waypoints_);
  }

  /// After each step of the mission.
  void note(const DriveMission& mission, const SimulatedRobot& robot) {
    const Pose2& truth = robot.pose();
    const double time_s = robot.time_s();
    clearance_m = std::min(clearance_m, ground_.clearance(truth.position, clearance_m));
    for (; arrivals_ < mission.arrivals.size(); ++arrivals_)
      arrived(time_s, mission.arrivals[arrivals_], truth);
    if (task_.closed_loop) note_passed(mission.follower.next, truth.position);
    note_deviation(truth.position);
    for (; relocalisations_ < mission.relocalisations.size(); ++relocalisations_)
      note_relocalisation(time_s, mission.relocalisations[relocalisations_]);
    if (mission.end != DriveEnd::none && !std::exchange(ended_, true)) note_end(time_s, mission);
    Reckoning now = mission.reckoning;  // the robot still rolls out after the last step
    advance(now, time_s, task_.reckoning, task_.chassis);
    note_error(now.belief, truth);
    if (time_s < next_s_ && mission.end == DriveEnd::none) return;
    next_s_ = time_s + belief_every_s - 1e-9;
    log_pose(log_, time_s, truth);
    log_belief(log_, time_s, now.belief.world_T_robot, now.belief.covariance, mission.used > used_);
    used_ = mission.used;
  }

  /// Returns each waypoint, what became of it, and how far off it the robot was when it was reached; NaN
  /// where it was not. Of a waypoint that is no stop: how near the robot came to it while it or the one
  /// behind it was the next one.
  [[nodiscard]] Table table() const {
    Table table{"waypoints",
                {"x", "y", "heading_rad", "stop", "outcome", "reached_s", "dx", "dy", "dtheta", "nearest_m"},
                {}};
    for (std::size_t i = 0; i < task_.waypoints.size(); ++i) {
      const outrider_msgs::Waypoint& one = waypoints_.waypoints[i];
      table.rows.push_back({one.position.x, one.position.y, one.heading, one.stop ? 1.0 : 0.0, outcome(i),
                            one.reached, one.error.x, one.error.y, one.heading_error, nearest_m_[i]});
    }
    return table;
  }

  /// Returns a sentence about the first waypoint that was missed; empty if there is none.
  [[nodiscard]] std::string missed() const {
    for (std::size_t i = 0; i < next_; ++i) {
      if (outcome(i) != "missed") continue;
      return fmt::format("waypoint {} was missed by {:.3f} m; it is passed within {:g} m (follow.pass)",
                         i + 1, nearest_m_[i], task_.follow.pass_m);
    }
    return {};
  }

  double clearance_m = 0.0;     ///< least distance of the robot's middle to an obstacle or the edge
  double deviation_m = 0.0;     ///< largest distance from the straight legs
  double belief_error_m = 0.0;  ///< largest error of the believed position
  double false_arrivals = 0.0;  ///< stops called reached where the robot is off by more than the tolerance
  double belief_error_ratio = 0.0;  ///< largest error of the believed position in standard deviations

 private:
  /// Notes how near the robot comes to the next waypoint and the one before, if they are no stops.
  void note_passed(std::size_t next, Vec2 position) {
    for (std::size_t i = next_ > 0 ? next_ - 1 : 0; i <= next; ++i) {
      if (!task_.waypoints[i].stop)
        nearest_m_[i] = std::fmin(nearest_m_[i], distance(position, task_.waypoints[i].pose.position));
    }
    next_ = next;
  }

  /// A waypoint that is no stop and lies behind the robot is passed only if the robot came near enough.
  [[nodiscard]] std::string outcome(std::size_t waypoint) const {
    if (!task_.closed_loop || task_.waypoints[waypoint].stop || waypoint >= next_) return outcomes_[waypoint];
    return nearest_m_[waypoint] <= task_.follow.pass_m ? "passed" : "missed";
  }

  /// Notes how far the robot is off the straight legs before and behind the last waypoint that it left.
  void note_deviation(Vec2 position) {
    const std::size_t next = task_.closed_loop ? next_ : std::min(arrivals_, task_.waypoints.size() - 1);
    double off_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = next > 0 ? next - 1 : 0; i <= next; ++i) {
      const Vec2 from = i == 0 ? task_.start.position : task_.waypoints[i - 1].pose.position;
      off_m = std::min(off_m, distance(position, Segment{from, task_.waypoints[i].pose.position}));
    }
    deviation_m = std::max(deviation_m, off_m);
  }

  void note_error(const PoseBelief& belief, const Pose2& truth) {
    const Vec2 off = truth.position - belief.world_T_robot.position;
    const Eigen::Vector2d error(off.x, off.y);
    const Eigen::Matrix2d covariance = belief.covariance.topLeftCorner<2, 2>();
    belief_error_m = std::max(belief_error_m, norm(off));
    belief_error_ratio =
        std::max(belief_error_ratio, std::sqrt(std::max(0.0, error.dot(covariance.ldlt().solve(error)))));
  }

  void note_end(double time_s, const DriveMission& mission) {
    if (mission.end == DriveEnd::lost || mission.end == DriveEnd::stuck)
      log_event(log_, time_s, mission.end == DriveEnd::lost ? "lost" : "stuck", mission.reason);
  }

  void note_relocalisation(double time_s, const Relocalisation& found) {
    const Pose2& pose = found.belief.world_T_robot;
    log_event(log_, time_s, "relocalised",
              fmt::format("by {} the robot is at {:.2f}, {:.2f}, {:.0f} degrees",
                          found.tags.size() > 1 ? "tags" : fmt::format("tag {} alone", *found.tags.begin()),
                          pose.position.x, pose.position.y, degrees(pose.heading_rad)));
  }

  void arrived(double time_s, const DriveArrival& arrival, const Pose2& truth) {
    outcomes_[arrival.waypoint] = arrival.doubt.empty() ? "reached" : "unconfirmed";
    if (!arrival.doubt.empty()) {
      log_event(log_, time_s, "unconfirmed",
                fmt::format("waypoint {} unconfirmed: {}", arrival.waypoint + 1, arrival.doubt));
      return;
    }
    const Pose2& pose = task_.waypoints[arrival.waypoint].pose;
    const Vec2 error = truth.position - pose.position;
    outrider_msgs::Waypoint& waypoint = waypoints_.waypoints[arrival.waypoint];
    waypoint.reached = arrival.time_s;
    waypoint.error = point_of(error);
    waypoint.heading_error = wrap_angle(truth.heading_rad - pose.heading_rad);
    if (norm(error) > tolerance_m(task_) || std::abs(waypoint.heading_error) > tolerance_rad(task_)) {
      false_arrivals += 1.0;
    }
    log_.append(topic::waypoints, time_s, waypoints_);
    log_event(log_, time_s, "arrive",
              fmt::format("waypoint {} reached, {:.1f} mm and {:.2f} degrees off", arrival.waypoint + 1,
                          1e3 * norm(error), degrees(waypoint.heading_error)));
  }

  const DriveTask& task_;
  const CollisionMap& ground_;
  Log& log_;
  outrider_msgs::Waypoints waypoints_;
  std::vector<std::string> outcomes_;  // of each waypoint at which the robot stood
  std::vector<double> nearest_m_;      // to each waypoint that is no stop
  std::size_t next_ = 0;
  std::size_t arrivals_ = 0;
  std::size_t relocalisations_ = 0;
  std::int64_t used_ = 0;
  double next_s_ = 0.0;
  bool ended_ = false;
};

std::string status_of(DriveEnd end) {
  switch (end) {
    case DriveEnd::done: return "done";
    case DriveEnd::unconfirmed: return "unconfirmed";
    case DriveEnd::doubtful: return "doubtful";
    case DriveEnd::none:
    case DriveEnd::lost:
    case DriveEnd::stuck: break;
  }
  return "not_done";
}

/// Returns the report of the drive.
Report judged(const DriveMission& mission, const SimulatedRobot& robot, const Recorder& recorder) {
  const DriveTask& task = mission.task;
  const DriveLegs ideal = straight_legs(task);
  const WheelBody& motion = robot.body<WheelBody>();
  const double too_near_m = task.radius_m - recorder.clearance_m;
  const bool touched = too_near_m > 0.0;
  Report report;
  report.world_name = task.world.name;
  const std::string missed = recorder.missed();
  const bool came_to_the_end = !mission.arrivals.empty() && status_of(mission.end) != "not_done";
  report.status = touched || !missed.empty() ? "not_done" : status_of(mission.end);
  report.reason = mission.reason;
  if (report.reason.empty() && touched) {
    report.reason = fmt::format("the robot came {:.3f} m too near to an obstacle or the edge", too_near_m);
  }
  if (!missed.empty()) report.reason += (report.reason.empty() ? "" : "; ") + missed;
  const double images = static_cast<double>(std::max<std::int64_t>(1, robot.devices().camera->images()));
  report.metrics = {{"driven_m", motion.driven_m()},
                    {"ideal_m", ideal.driven_m},
                    {"turned_rad", motion.turned_rad()},
                    {"ideal_rad", ideal.turned_rad},
                    {"tag_fraction", static_cast<double>(mission.used) / images},
                    {"ideal_s", ideal_s(task)},
                    {"time_s", came_to_the_end ? mission.arrivals.back().time_s : motion.time_s()},
                    {"clearance_m", recorder.clearance_m},
                    {"deviation_m", recorder.deviation_m},
                    {"belief_error_m", recorder.belief_error_m},
                    {"belief_error_ratio", recorder.belief_error_ratio},
                    {"false_arrivals", recorder.false_arrivals},
                    {"tolerance_m", tolerance_m(task)},
                    {"tolerance_rad", tolerance_rad(task)}};
  report.tables = {recorder.table()};
  return report;
}

}  // namespace

outrider_msgs::Waypoints waypoints_message(const DriveTask& task) {
  outrider_msgs::Waypoints message;
  message.closed_loop = task.closed_loop;
  for (const Waypoint& waypoint : task.waypoints) {
    message.waypoints.push_back({point_of(waypoint.pose.position),
                                 waypoint.pose.heading_rad,
                                 waypoint.stop,
                                 unknown,
                                 {unknown, unknown},
                                 unknown});
  }
  return message;
}

void log_tags(Log& log, const DriveTask& task) {
  if (task.tags.tags.empty()) return;
  outrider_msgs::Tags tags;
  for (const Tag& tag : task.tags.tags) {
    tags.tags.push_back({tag.id, point_of(tag.world_T_tag.position),
                         heading_of(xy(-1.0 * tag.world_T_tag.rotation.axes[2])), tag.size_m});
  }
  log.append(topic::tags, 0.0, std::move(tags));
  if (!task.closed_loop) return;
  log_camera(log, task.eye.camera);
  log_mount(log, "camera", {{task.eye.ahead_m, 0.0}, 0.0}, task.eye.height_m);
}

void log_start(Log& log, const DriveTask& task, std::uint64_t seed) {
  constexpr double any_m = std::numeric_limits<double>::infinity();  // every solid is in its way
  log_scene(log, run_info("drive", seed, task.world, task.radius_m), task.world, any_m);
  log_tags(log, task);
  std::vector<Vec2> way = {task.start.position};
  for (const Waypoint& waypoint : task.waypoints) way.push_back(waypoint.pose.position);
  log_plan(log, 0.0, way);
  log_markers(log);
}

DriveLegs straight_legs(const DriveTask& task) {
  DriveLegs legs;
  Vec2 from = task.start.position;
  double heading_rad = task.start.heading_rad;
  for (const Waypoint& waypoint : task.waypoints) {
    const Vec2 way = waypoint.pose.position - from;
    legs.driven_m += norm(way);
    if (turns_to_go(task) && norm(way) > 0.0) {
      legs.turned_rad += std::abs(wrap_angle(heading_of(way) - heading_rad));
      heading_rad = heading_of(way);
    }
    if (waypoint.stop) {
      legs.turned_rad += std::abs(wrap_angle(waypoint.pose.heading_rad - heading_rad));
      heading_rad = waypoint.pose.heading_rad;
    }
    from = waypoint.pose.position;
  }
  return legs;
}

SimulatedRobot simulated_driver(const DriveTask& task, const DriveSimParams& params, bool rendered,
                                std::uint64_t seed) {
  const Rng rng(seed);
  TagCameraOptions options;
  options.rate_hz = task.eye.rate_hz;
  options.exposure_s = task.eye.exposure_s;
  options.latency_s = task.eye.latency_s;
  TagSightFaults faults = params.sight;
  if (!task.closed_loop) faults.blind_from_s = 0.0;
  SimulatedTagCamera camera({task.world, true_tags(task.tags, params)}, robot_camera(task.eye), options,
                            faults, rendered, rng);
  camera.expect_sizes(task.tags);
  if (params.moved_tag.at_s > 0.0)
    camera.change_tags(params.moved_tag.at_s, true_tags_later(task.tags, params));
  return SimulatedRobot(
      WheelBody(task.chassis, params.wheels, params.link, params.patience_s, task.start, rng),
      {.camera = std::move(camera)}, params.kidnapping, params.clock);
}

Report run_drive(const DriveTask& task, const DriveSimParams& params, bool rendered, std::uint64_t seed,
                 Log& log, const RunWatch& watch) {
  log_start(log, task, seed);
  const CollisionMap ground = CollisionMap::of(task.world, task.eye.height_m);
  SimulatedRobot robot = simulated_driver(task, params, rendered, seed);
  DriveMission mission = begin(task);
  Recorder recorder(task, ground, log);
  SteadyMission steady{mission, {}};
  const bool finished = run_mission(steady, robot, watch.stop, [&](const Observation&, const Command*) {
    recorder.note(mission, robot);
    watch.part(static_cast<double>(mission.arrivals.size()) / static_cast<double>(task.waypoints.size()));
  });
  Report report = judged(mission, robot, recorder);
  if (!finished) mark_cancelled(report, log, robot.time_s());
  return report;
}

std::vector<CalibrationRun> record_runs(const DriveTask& task, const DriveSimParams& params, int repeats,
                                        double sigma_m, double sigma_rad, std::uint64_t seed) {
  constexpr double coast_s = 2.0, held_s = 1e9;  // a command is sent once
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
        WheelBody motion(task.chassis, params.wheels, params.link, held_s, {}, rng.child(runs.size()));
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
