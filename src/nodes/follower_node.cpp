#include "outrider/nodes/follower_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/jobs/explore/mission/task.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

constexpr double near_m = 1.2;     // obstacles that matter
constexpr double stand_s = 2.0;    // commands to stand are sent for
constexpr double kept_s = 3.0;     // commands
constexpr double blocked_s = 3.0;  // without getting on, after which the robot goes back
constexpr double got_on_m = 0.05;  // that count as getting on
constexpr double back_s = 1.5;
constexpr double trail_step_m = 0.02;
constexpr std::size_t most_trail = 20;
constexpr double there_m = 0.015;

Option patience(std::string name, std::string what, double* value) {
  return {std::move(name), "s", 0.05, 1e6, "age of the newest " + what + " at which it stops", value};
}

double approach(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

}  // namespace

FollowerNodeOptions::FollowerNodeOptions() : robot(burger()) {
  steer.gap_m = 0.03;
  steer.foresight_s = 0.8;
}

std::vector<OptionGroup> describe(FollowerNodeOptions& options) {
  return {
      {"",
       "driving",
       {{"plain_twist", "", 0, 0, "commands are geometry_msgs/Twist, not TwistStamped", &options.plain_twist},
        patience("odom_patience", "odometry", &options.odom_patience_s),
        patience("scan_patience", "scan", &options.scan_patience_s),
        patience("pose_patience", "transform from map to odometry", &options.pose_patience_s),
        {"map_patience", "s", 0.0, 1e9, "age of the map at which it stops; 0: it never becomes too old",
         &options.map_patience_s},
        {"reaction", "s", 0.0, 2.0, "from a command until the robot obeys", &options.reaction_s},
        {"turn_within", "deg", 1.0, 180.0, "of the heading at the end of a path", &options.turn_within_rad}}},
      {"robot", "the robot, a disk on two wheels", describe(options.robot)},
      {"steer", "how it drives", describe(options.steer)},
      {"frame", "names of the frames", describe(options.frames)}};
}

FollowerNode::FollowerNode(FollowerNodeOptions options)
    : Node("follower", 0.05), options_(std::move(options)), frames_(options_.frames), scan_(2.0 * near_m) {
  listen<nav_msgs::Path>("plan", Delivery::reliable, [this](const auto& path) { return take_plan(path); });
  listen<nav_msgs::Odometry>("odom", Delivery::sensor,
                             [this](const auto& odometry) { return take_odometry(odometry); });
  listen<sensor_msgs::LaserScan>("scan", Delivery::sensor,
                                 [this](const auto& scan) { return scan_.take(scan, frames_, now_s()); });
  listen<nav_msgs::OccupancyGrid>("map", Delivery::latched,
                                  [this](const auto& map) { return take_map(map); });
  listen_to_transforms(frames_);
  command_output_ = options_.plain_twist
                        ? add_output<geometry_msgs::Twist>("cmd_vel", Delivery::reliable)
                        : add_output<geometry_msgs::TwistStamped>("cmd_vel", Delivery::reliable);
  set_status(NodeLevel::info, "waiting", "no path has come yet");
}

Status FollowerNode::take_plan(const nav_msgs::Path& path) {
  if (auto time_s = plans_.take(path.header.stamp); !time_s) return pass_on(time_s);
  if (path.header.frame_id != options_.frames.map) {
    return bad_input(fmt::format("the path is given in the frame '{}'; give it in '{}'",
                                 excerpt(path.header.frame_id), options_.frames.map));
  }
  if (path.poses.empty()) {  // nothing to follow any more
    path_.reset();
    return {};
  }
  const auto poses = checked_path(path);
  if (!poses) return pass_on(poses);
  PathProgress next;
  for (const Pose2& pose : *poses) next.points.push_back(pose.position);
  if (!path_ || path_->points.back() != next.points.back()) moved_on_s_ = now_s();
  path_ = std::move(next);
  last_heading_rad_ = poses->back().heading_rad;
  return {};
}

Status FollowerNode::take_odometry(const nav_msgs::Odometry& odometry) {
  const std::optional<double> before_s = odometries_.newest_s();
  const auto time_s = odometries_.take(odometry.header.stamp);
  if (!time_s) return pass_on(time_s);
  if (auto ok = frames_.add(odometry); !ok) return ok;
  const geometry_msgs::Twist& twist = odometry.twist.twist;
  if (!std::isfinite(twist.linear.x) || !std::isfinite(twist.angular.z))
    return bad_input("its twist is not finite");
  if (before_s != *time_s) odometry_came_s_ = now_s();  // the same once more is not new
  odometry_ = pose_of(odometry.pose.pose);
  twist_ = {std::clamp(twist.linear.x, -100.0, 100.0), 0.0, std::clamp(twist.angular.z, -100.0, 100.0)};
  return {};
}

Status FollowerNode::take_map(const nav_msgs::OccupancyGrid& map) {
  if (auto time_s = maps_.take(map.header.stamp); !time_s) return pass_on(time_s);
  auto grid = checked_map(map);
  if (!grid) return pass_on(grid);
  if (beginning_.is_another(map)) {
    path_.reset();
    tell(NodeLevel::warning, "the map was begun anew, so the path holds no more");
  }
  map_ = std::move(*grid);
  map_came_s_ = now_s();
  return {};
}

/// Returns why the robot must not drive now; empty if it may.
std::string FollowerNode::why_to_stop() const {
  if (auto why = why_missing("odometry", odometry_came_s_, options_.odom_patience_s); !why.empty())
    return why;
  if (auto why = why_missing("scan", scan_.came_s(), options_.scan_patience_s); !why.empty()) return why;
  if (auto why =
          why_missing(fmt::format("transform from '{}' to '{}'", options_.frames.map, options_.frames.odom),
                      frames_.localised_s(), options_.pose_patience_s);
      !why.empty())
    return why;
  if (options_.map_patience_s <= 0.0) return {};
  return why_missing("map", map_came_s_, options_.map_patience_s);
}

/// Returns where on the odometry the robot will be, and how it will move, once it obeys the next command.
std::pair<Pose2, Twist2> FollowerNode::predicted() const {
  constexpr double step_s = 0.02, longest_s = 1.0;
  Pose2 pose = odometry_;
  Twist2 twist = twist_;
  const double from_s = std::max(*odometries_.newest_s(), now_s() - longest_s);
  for (double at_s = from_s; at_s < now_s() + options_.reaction_s; at_s += step_s) {
    Twist2 wanted;
    for (const Command& given : commands_) {
      if (given.time_s + options_.reaction_s <= at_s) wanted = given.twist;
    }
    twist.ahead_mps = approach(twist.ahead_mps, wanted.ahead_mps, options_.robot.acceleration_mps2 * step_s);
    twist.turn_radps =
        approach(twist.turn_radps, wanted.turn_radps, options_.robot.turn_acceleration_radps2 * step_s);
    pose = moved(pose, twist, step_s);
  }
  return {pose, twist};
}

/// Returns what the newest scan and the map show around the robot.
Nearby FollowerNode::obstacles(const Pose2& map_T_robot) const {
  Nearby nearby;
  if (map_.frame.size() > 0) nearby = Nearby(map_, map_T_robot.position, near_m);
  const Pose2 map_T_then = compose(*frames_.map_T_odom(), *frames_.odom_T_robot(scan_.time_s()));
  std::vector<Vec2> points;
  for (const Vec2 end : scan_.points()) {
    const Vec2 point = map_T_then * end;
    if (distance(point, map_T_robot.position) < near_m) points.push_back(point);
  }
  nearby.add(points);
  return nearby;
}

void FollowerNode::command(const Twist2& twist) {
  if (twist != Twist2{}) driven_s_ = now_s();
  commands_.push_back({now_s(), twist});
  while (now_s() - commands_.front().time_s > kept_s) commands_.pop_front();
  geometry_msgs::TwistStamped message;
  message.header = header_of(now_s(), options_.frames.base);
  message.twist.linear.x = twist.ahead_mps;
  message.twist.angular.z = twist.turn_radps;
  options_.plain_twist ? send(command_output_, message.twist) : send(command_output_, message);
}

/// Keeps where the robot came from.
void FollowerNode::note_trail(Vec2 at) {
  if (!trail_.empty() && distance(trail_.back(), at) < trail_step_m) return;
  trail_.push_back(at);
  if (trail_.size() > most_trail) trail_.pop_front();
}

/// Drives backwards along the way it came.
Twist2 FollowerNode::steer_back(const Pose2& pose, const Twist2& now, const Nearby& nearby) const {
  PathProgress back{{pose.position}, 0.0};
  for (auto at = trail_.rbegin(); at != trail_.rend(); ++at)
    back.points.push_back(*frames_.map_T_odom() * *at);
  RobotModel slow = options_.robot;
  slow.speed_mps *= 0.5;
  const Twist2 twist = steer(back, {pose.position, pose.heading_rad + pi},
                             {-now.ahead_mps, 0.0, now.turn_radps}, nearby, slow, options_.steer);
  return {-twist.ahead_mps, 0.0, twist.turn_radps};
}

/// Stands still; says so to the robot for a while only.
void FollowerNode::stand() {
  if (now_s() - driven_s_ <= stand_s) command({});
}

void FollowerNode::drive() {
  const auto map_T_odom = frames_.map_T_odom();
  if (!map_T_odom || !frames_.odom_T_robot(scan_.time_s())) {
    set_status(NodeLevel::error, "stopped", "the pose of the robot on the map is not finite");
    return stand();
  }
  const auto [odom_T_robot, twist] = predicted();
  const Pose2 pose = compose(*map_T_odom, odom_T_robot);
  advance_along(*path_, pose.position);
  if (distance(odom_T_robot.position, stood_) > got_on_m) {
    stood_ = odom_T_robot.position;
    moved_on_s_ = now_s();
  }
  const double left_m = std::max(remaining_m(*path_), distance(pose.position, path_->points.back()));
  const double turn_rad = wrap_angle(last_heading_rad_ - pose.heading_rad);
  if (left_m < there_m) {
    if (std::abs(turn_rad) <= options_.turn_within_rad) {
      set_status(NodeLevel::info, "arrived", "the robot is at the end of its path");
      return stand();
    }
    const double rate = std::min(options_.robot.turn_rate_radps,
                                 std::abs(turn_rad) / (options_.steer.settle_s + options_.reaction_s));
    return command({0.0, 0.0, std::copysign(rate, turn_rad)});
  }
  const Nearby nearby = obstacles(pose);
  if (now_s() < backs_until_s_) return command(steer_back(pose, twist, nearby));
  note_trail(odom_T_robot.position);
  const Twist2 next = steer(*path_, pose, twist, nearby, options_.robot, options_.steer);
  if (now_s() - moved_on_s_ > blocked_s && next.ahead_mps < 0.01) {
    set_status(NodeLevel::warning, "stopped",
               "the scan or the map shows something in the way; the robot goes back a little");
    backs_until_s_ = now_s() + back_s;
    moved_on_s_ = backs_until_s_;
  } else {
    set_status(NodeLevel::info, "driving", "the robot drives along its path");
  }
  command(next);
}

void FollowerNode::act() {
  if (!path_) {
    set_status(NodeLevel::info, "waiting", "no path has come yet");
    return stand();
  }
  if (const std::string why = why_to_stop(); !why.empty()) {
    set_status(NodeLevel::error, "stopped", why);
    return stand();
  }
  drive();
}

}  // namespace outrider
