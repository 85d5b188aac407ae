#include "outrider/jobs/drive/mission/laser_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mission/zone_judge.hpp"
#include "outrider/job/navigation_log.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

constexpr double log_every_s = 0.2;
constexpr double most_way_m = 20.0;         // of the planned way that is logged
constexpr double corner_rad = radians(15);  // of the outline that is logged, at most, where it is round
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool sees_tags(const LaserDriveOptions& options) { return options.navigator.localiser == "tags"; }

NavigatorSetup setup_of(const DriveTask& task, double height_m, const LaserDriveOptions& options,
                        const Footprint& footprint) {
  RobotModel robot;
  robot.radius_m = footprint.outer_m();
  robot.height_m = height_m;
  robot.speed_mps = task.follow.speed_mps;
  robot.acceleration_mps2 = task.follow.acceleration_mps2;
  robot.turn_rate_radps = task.follow.turn_rate_radps;
  robot.turn_acceleration_radps2 = task.follow.turn_acceleration_radps2;
  robot.turning_radius_m = options.turning_radius_m;
  NavigatorSetup setup = setup_of(options, robot, footprint);
  setup.known = task.known;
  if (sees_tags(options)) setup.tags = TagsInSight{task.tags, robot_camera(task.eye), task.localise};
  setup.zones = task.zones;
  setup.keep = options.keep;
  return setup;
}

/// Returns the camera that sees tags, if the robot is localised by them.
std::optional<SimulatedTagCamera> camera_of(const DriveTask& task, const LaserDriveOptions& options,
                                            std::uint64_t seed) {
  if (!sees_tags(options)) return std::nullopt;
  TagCameraOptions camera;
  camera.rate_hz = task.eye.rate_hz;
  camera.exposure_s = task.eye.exposure_s;
  camera.latency_s = task.eye.latency_s;
  return SimulatedTagCamera({task.world, options.hung.value_or(task.tags)}, robot_camera(task.eye), camera,
                            {}, options.rendered, Rng(seed));
}

/// The waypoints one after another, each an order.
class LaserDrive {
 public:
  LaserDrive(const DriveTask& task, const LaserDriveOptions& options, Navigator navigator,
             SimulatedRobot robot, ZoneJudge zones, Log& log)
      : task_(task),
        options_(options),
        navigator_(std::move(navigator)),
        robot_(std::move(robot)),
        zones_(std::move(zones)),
        log_(log),
        waypoints_(waypoints_message(task)),
        outcomes_(task.waypoints.size(), "not reached") {
    log_.append(topic::waypoints, 0.0, waypoints_);
  }

  /// Drives until the last waypoint, or until it is stopped or cannot go on.
  bool run(const RunWatch& watch) {
    while (next_ < task_.waypoints.size() && reason_.empty()) {
      const Observation seen = robot_.sense();
      zones_.note(robot_.time_s(), robot_.pose());
      const Situation now = navigator_.perceive(seen);
      if (navigator_.is_located()) note_belief(now);
      note(seen, now);
      if (answered_) judge(now);
      if (watch.stopped()) return false;
      const Order order = next_ < task_.waypoints.size() ? Order{order_to(next_)} : Order{Hold{}};
      robot_.act(navigator_.act(order));
      answered_ = true;
      recoveries_ = std::max(recoveries_, navigator_.recoveries());
      watch.part(static_cast<double>(next_) / static_cast<double>(task_.waypoints.size()));
    }
    log_plan(log_, robot_.time_s(), {});
    log_pose(log_, robot_.time_s(), robot_.pose());
    return true;
  }

  [[nodiscard]] Report report() const;
  [[nodiscard]] double time_s() const { return robot_.time_s(); }

 private:
  [[nodiscard]] GoTo order_to(std::size_t waypoint) const {
    const Waypoint& to = task_.waypoints[waypoint];
    GoTo order{to.pose.position, options_.within_m};
    if (to.stop) order.heading_rad = to.pose.heading_rad;
    order.within_rad = options_.within_rad;
    return order;
  }

  void note_belief(const Situation& now) {
    if (located_m_ < 0.0) located_m_ = robot_.body<TwistBody>().driven_m();
    belief_error_m_ = std::max(belief_error_m_, distance(now.pose.position, robot_.pose().position));
  }

  void judge(const Situation& now) {
    switch (now.progress.state) {
      case Progress::State::underway: return;
      case Progress::State::arrived: arrive(); return;
      case Progress::State::blocked:
      case Progress::State::lost: {
        reason_ = fmt::format("waypoint {} was not reached: {}", next_ + 1, now.progress.why);
        const bool lost = now.progress.state == Progress::State::lost;
        log_event(log_, now.time_s, lost ? "lost" : "stuck", reason_);
      }
    }
  }

  void arrive() {
    const Waypoint& to = task_.waypoints[next_];
    const Pose2& truth = robot_.pose();
    const Vec2 error = truth.position - to.pose.position;
    outrider_msgs::Waypoint& waypoint = waypoints_.waypoints[next_];
    waypoint.reached = robot_.time_s();
    waypoint.error = point_of(error);
    waypoint.heading_error = to.stop ? wrap_angle(truth.heading_rad - to.pose.heading_rad) : 0.0;
    const bool there = norm(error) <= 2.0 * options_.within_m &&
                       std::abs(waypoint.heading_error) <= 2.0 * options_.within_rad;
    if (!there) ++false_arrivals_;
    outcomes_[next_] = to.stop ? "reached" : "passed";
    log_.append(topic::waypoints, robot_.time_s(), waypoints_);
    log_event(log_, robot_.time_s(), "arrive",
              fmt::format("waypoint {} reached, {:.2f} m and {:.1f} degrees off", next_ + 1, norm(error),
                          degrees(waypoint.heading_error)));
    ++next_;
    answered_ = false;
  }

  void note(const Observation& seen, const Situation& now) {
    navigation_log_.note(seen, now.time_s, navigator_.map());
    if (now.time_s < next_log_s_) return;
    next_log_s_ = now.time_s + log_every_s - 1e-9;
    log_pose(log_, now.time_s, robot_.pose());
    log_odometry(log_, now.time_s, seen.odometry);
    if (!navigator_.is_located()) return;
    log_belief(log_, now.time_s, now.pose, now.covariance, false);
    if (answered_) log_plan(log_, now.time_s, navigator_.way(most_way_m));
  }

  [[nodiscard]] Table table() const {
    Table table{"waypoints",
                {"x", "y", "heading_rad", "stop", "outcome", "reached_s", "dx", "dy", "dtheta", "nearest_m"},
                {}};
    for (std::size_t i = 0; i < task_.waypoints.size(); ++i) {
      const outrider_msgs::Waypoint& one = waypoints_.waypoints[i];
      const double nearest_m = one.stop ? unknown : std::hypot(one.error.x, one.error.y);
      table.rows.push_back({one.position.x, one.position.y, one.heading, one.stop ? 1.0 : 0.0, outcomes_[i],
                            one.reached, one.error.x, one.error.y, one.heading_error, nearest_m});
    }
    return table;
  }

  const DriveTask& task_;
  const LaserDriveOptions& options_;
  Navigator navigator_;
  SimulatedRobot robot_;
  ZoneJudge zones_;
  Log& log_;
  NavigationLog navigation_log_{log_};
  outrider_msgs::Waypoints waypoints_;
  std::vector<std::string> outcomes_;
  std::size_t next_ = 0;
  bool answered_ = false;  // the navigator has had the order to the next waypoint
  std::string reason_;
  double located_m_ = -1.0;
  double belief_error_m_ = 0.0;
  std::int64_t false_arrivals_ = 0;
  std::int64_t recoveries_ = 0;
  double next_log_s_ = 0.0;
};

Report LaserDrive::report() const {
  const auto& body = robot_.body<TwistBody>();
  Report report;
  report.world_name = task_.world.name;
  const bool arrived = next_ == task_.waypoints.size();
  const auto add = [&](const std::string& reason) {
    report.reason += (report.reason.empty() ? "" : "; ") + reason;
  };
  report.reason = reason_;
  if (body.contacts() > 0) add("something was touched");
  if (zones_.entered() > 0) add("the robot entered a keep-out zone");
  if (false_arrivals_ > 0)
    add(fmt::format("{} waypoint{} called reached where the robot was not", false_arrivals_,
                    false_arrivals_ == 1 ? " was" : "s were"));
  report.status = arrived && report.reason.empty() ? "done" : "not_done";
  const DriveLegs legs = straight_legs(task_);
  report.metrics = {{"driven_m", body.driven_m()},
                    {"ideal_m", legs.driven_m},
                    {"turned_rad", body.turned_rad()},
                    {"ideal_rad", legs.turned_rad},
                    {"time_s", robot_.time_s()},
                    {"contacts", static_cast<double>(body.contacts())},
                    {"walked_into", static_cast<double>(body.walked_into())},
                    {"recoveries", static_cast<double>(recoveries_)},
                    {"located_m", located_m_},
                    {"belief_error_m", belief_error_m_},
                    {"false_arrivals", static_cast<double>(false_arrivals_)},
                    {"kept_out", static_cast<double>(zones_.entered())},
                    {"over_slow_s", zones_.over_slow_s()}};
  report.tables = {table()};
  return report;
}

}  // namespace

std::vector<OptionGroup> describe(LaserDriveOptions& options) {
  const std::vector<Option> more = {
      {"footprint", "", 0, 0,
       "corners x,y of the robot in m, counter-clockwise, with blanks between, or a radius; empty: "
       "its disk",
       &options.footprint},
      {"turning_radius", "m", 0.0, 100.0,
       "of the tightest curve that the robot can drive, as of a car; 0: it turns in place",
       &options.turning_radius_m},
      {"within", "m", 0.01, 10.0, "distance from a waypoint within which it is reached", &options.within_m},
      {"within_heading", "deg", 0.1, 180.0, "the same of the heading at a stop", &options.within_rad},
      {"start_unknown", "", 0, 0, "the robot is not told where on its map it starts",
       &options.start_unknown}};
  std::vector<OptionGroup> groups = describe(static_cast<NavigationOptions&>(options));
  const auto navigator = std::ranges::find(groups, "navigator", &OptionGroup::name);
  navigator->options.insert(navigator->options.begin(), more.begin(), more.end());
  return groups;
}

Outcome<Footprint> footprint_of(const LaserDriveOptions& options, double radius_m) {
  if (options.footprint.empty()) return Footprint::disk(radius_m);
  auto shape = parse_footprint(options.footprint);
  if (!shape) return pass_on(shape);
  return Footprint(std::move(*shape));
}

Outcome<Report> run_laser_drive(const DriveTask& task, double height_m, const LaserDriveOptions& options,
                                std::uint64_t seed, Log& log, const RunWatch& watch) {
  const auto footprint = footprint_of(options, task.radius_m);
  if (!footprint) return tl::unexpected(footprint.error());
  const NavigatorSetup setup = setup_of(task, height_m, options, *footprint);
  auto navigator = Navigator::make(setup, options.start_unknown ? std::nullopt : std::optional(task.start));
  if (!navigator) return pass_on(navigator);
  // Its radius is that of the disk that fits into it: no place nearer to a thing can be driven through.
  log_scene(log, run_info("drive", seed, task.world, footprint->inner_m()), task.world, height_m);
  if (footprint->shape().core.size() > 1) log_footprint(log, inscribed(footprint->shape(), corner_rad));
  log_mount(log, "laser", options.laser.robot_T_laser, options.laser.height_m);
  if (sees_tags(options)) log_tags(log, task);
  log_zones(log, task.zones);
  log_markers(log);
  LaserDrive drive(task, options, std::move(*navigator),
                   simulated_explorer(task.world, task.start, setup.robot, devices_of(options, *footprint),
                                      seed, camera_of(task, options, seed)),
                   ZoneJudge(task.zones, *footprint), log);
  const bool finished = drive.run(watch);
  Report report = drive.report();
  if (!finished) mark_cancelled(report, log, drive.time_s());
  return report;
}

}  // namespace outrider
