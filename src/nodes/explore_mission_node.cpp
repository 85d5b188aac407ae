#include "outrider/nodes/explore_mission_node.hpp"

#include <fmt/format.h>

#include <utility>

#include "outrider/core/text.hpp"
#include "outrider/io/scan_mount.hpp"
#include "outrider/log/conversions.hpp"

namespace outrider {

ExploreMissionNode::ExploreMissionNode(ExploreMissionNodeOptions options)
    : Node("explore", 0.05, "explore/status"), options_(std::move(options)), frames_(options_.frames) {
  listen<sensor_msgs::LaserScan>("scan", Delivery::sensor,
                                 [this](const auto& scan) { return take_scan(scan); });
  listen<nav_msgs::Odometry>("odom", Delivery::sensor,
                             [this](const auto& odometry) { return take_odometry(odometry); });
  listen_to_transforms(frames_);
  command_output_ = options_.plain_twist
                        ? add_output<geometry_msgs::Twist>("cmd_vel", Delivery::reliable)
                        : add_output<geometry_msgs::TwistStamped>("cmd_vel", Delivery::reliable);
  map_output_ = add_output<nav_msgs::OccupancyGrid>("map", Delivery::latched);
  pose_output_ = add_output<geometry_msgs::PoseStamped>("pose", Delivery::reliable);
  transform_output_ = add_output<tf2_msgs::TFMessage>("/tf", Delivery::reliable);
  goal_output_ = add_output<geometry_msgs::PoseStamped>("goal_pose", Delivery::reliable);
  plan_output_ = add_output<nav_msgs::Path>("plan", Delivery::reliable);
  set_status(NodeLevel::info, "waiting", "no scan has come yet");
}

Status ExploreMissionNode::take_scan(const sensor_msgs::LaserScan& scan) {
  const std::optional<double> before_s = scans_.newest_s();
  const auto time_s = scans_.take(scan.header.stamp);
  if (!time_s) return tl::unexpected<Fault>(time_s.error());
  if (auto ok = check(scan_of(scan, false, *time_s)); !ok) return ok;
  if (before_s == *time_s) return {};
  scan_came_s_ = now_s();
  waiting_ = scan;
  perceive_waiting();
  return {};
}

Status ExploreMissionNode::take_odometry(const nav_msgs::Odometry& odometry) {
  const std::optional<double> before_s = odometries_.newest_s();
  const auto time_s = odometries_.take(odometry.header.stamp);
  if (!time_s) return tl::unexpected<Fault>(time_s.error());
  if (auto ok = frames_.add(odometry); !ok) return ok;
  if (before_s != *time_s) odometry_came_s_ = now_s();
  perceive_waiting();
  return {};
}

Status ExploreMissionNode::start(const Pose2& robot_T_laser) {
  options_.task.start = {};
  options_.task.slam.robot_T_laser = robot_T_laser;
  auto begun = begin(options_.task);
  if (!begun) return pass_on(begun);
  mission_.emplace(std::move(*begun));
  return {};
}

void ExploreMissionNode::perceive_at(double time_s, std::optional<LaserScan> scan) {
  const auto odometry = frames_.odom_T_robot(time_s);
  if (!odometry || mission_->stage == ExploreStage::over) return;
  Observation seen;
  seen.time_s = time_s;
  seen.odometry = *odometry;
  seen.scan = std::move(scan);
  perceive(*mission_, seen);
  seen_s_ = time_s;
}

/// Lets the mission see the scan that waits, once its odometry is known.
void ExploreMissionNode::perceive_waiting() {
  if (!waiting_ || !frames_.knows_odometry_at(*scans_.newest_s())) return;
  const sensor_msgs::LaserScan message = *std::exchange(waiting_, std::nullopt);
  const auto pose = frames_.robot_T(message.header.frame_id);
  const auto mount = pose ? scan_mount(*pose)
                          : Outcome<ScanMount>(bad_input(
                                fmt::format("no transform says where '{}' is on '{}'",
                                            printable(message.header.frame_id), options_.frames.base)));
  if (!mount) return tell(NodeLevel::warning, "scan: " + mount.error().sentence);
  if (!mission_) {
    if (auto ok = start(mount->robot_T_laser); !ok) return tell(NodeLevel::error, ok.error().sentence);
  }
  perceive_at(*scans_.newest_s(), scan_of(message, mount->upside_down, *scans_.newest_s()));
}

std::string ExploreMissionNode::why_to_stop() const {
  const auto missing = [&](std::string_view what, const std::optional<double>& came_s) {
    if (!came_s) return fmt::format("no {} has come yet", what);
    if (now_s() - *came_s > options_.patience_s)
      return fmt::format("no {} has come for {:g} s", what, options_.patience_s);
    return std::string();
  };
  const std::string why = missing("odometry", odometry_came_s_);
  return why.empty() ? missing("scan", scan_came_s_) : why;
}

void ExploreMissionNode::command(const Twist2& twist) {
  geometry_msgs::TwistStamped message;
  message.header = header_of(now_s(), options_.frames.base);
  message.twist.linear.x = twist.ahead_mps;
  message.twist.angular.z = twist.turn_radps;
  options_.plain_twist ? send(command_output_, message.twist) : send(command_output_, message);
}

void ExploreMissionNode::drive() {
  if (*odometries_.newest_s() > seen_s_) perceive_at(*odometries_.newest_s(), std::nullopt);
  const std::optional<Command> next = respond(*mission_);
  const auto* twist = next ? std::get_if<DriveTwist>(&*next) : nullptr;
  command(twist != nullptr ? twist->twist : Twist2{});
  if (next) return set_status(NodeLevel::info, "exploring", mission_->decision.sentence);
  over_ = true;
  const bool good =
      mission_->stop_reason == "complete" && (mission_->home || !options_.task.rules.return_home);
  set_status(good ? NodeLevel::info : NodeLevel::error, mission_->stop_reason,
             mission_->home ? mission_->reason + "; the robot is home" : mission_->reason);
}

void ExploreMissionNode::publish() {
  tf2_msgs::TFMessage transforms;
  const Pose2 map_T_odom = wrap_heading(compose(mission_->pose, inverse(mission_->odometry)));
  transforms.transforms.push_back(
      transform_of(now_s(), map_T_odom, options_.frames.map, options_.frames.odom));
  send(transform_output_, transforms);
  send(pose_output_, stamped(seen_s_, mission_->pose, options_.frames.map));
  if (over_ || now_s() - map_sent_s_ >= options_.map_period_s) {
    map_sent_s_ = now_s();
    send(map_output_, map_message(explored_map(*mission_), now_s(), options_.frames.map));
  }
  if (mission_->goal_changes == goal_changes_ || !mission_->path) return;
  goal_changes_ = mission_->goal_changes;
  send(goal_output_, stamped(now_s(), mission_->decision.goal, options_.frames.map));
  send(plan_output_, path_of(now_s(), mission_->path->points, options_.frames.map));
}

void ExploreMissionNode::act() {
  if (over_) return command({});
  const std::string why = why_to_stop();
  if (!why.empty() || !mission_) {
    if (!why.empty()) set_status(NodeLevel::error, mission_ ? "stopped" : "waiting", why);
    return command({});
  }
  drive();
  publish();
}

}  // namespace outrider
