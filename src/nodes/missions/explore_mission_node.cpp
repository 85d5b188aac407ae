#include "outrider/nodes/missions/explore_mission_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "outrider/core/text.hpp"
#include "outrider/io/log/scan_mount.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

/// Returns a box about all cells that are known.
Box2 seen_box(const Grid<std::uint8_t>& map) {
  constexpr double margin_m = 0.5;
  Box2 box;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] != unknown_cell) box.include(map.frame.centre(map.frame.cell(i)));
  }
  return box.empty() ? map.frame.bounds() : box.grown(margin_m);
}

}  // namespace

ExploreMissionNode::ExploreMissionNode(ExploreMissionNodeOptions options)
    : MissionNode("explore", options.node, 0.05),
      map_period_s_(options.map_period_s),
      task_(std::move(options.task)) {
  listen<sensor_msgs::LaserScan>("scan", Delivery::sensor,
                                 [this](const auto& scan) { return take_scan(scan); });
  listen_to_pose();
  transform_output_ = add_output<tf2_msgs::TFMessage>("/tf", Delivery::reliable);
  set_status(NodeLevel::info, "waiting", "no scan has come yet");
}

Status ExploreMissionNode::take_scan(const sensor_msgs::LaserScan& scan) {
  const std::optional<double> before_s = scans_.newest_s();
  const auto time_s = scans_.take(scan.header.stamp);
  if (!time_s) return pass_on(time_s);
  if (auto ok = check(scan_of(scan, false, *time_s)); !ok) return ok;
  if (before_s == *time_s) return {};
  scan_came_s_ = now_s();
  waiting_ = scan;
  perceive_waiting();
  return {};
}

Status ExploreMissionNode::start(const Pose2& robot_T_laser) {
  task_.start = {};
  task_.slam.robot_T_laser = robot_T_laser;
  auto begun = outrider::begin(task_);
  if (!begun) return pass_on(begun);
  mission_.emplace(std::move(*begun));
  begin_log(*scans_.newest_s());
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  info_.job = "explore";
  info_.robot_radius = task_.robot.radius_m;
  info_.low = info_.high = {unknown, unknown};  // until all is mapped
  log().append(topic::run, 0.0, info_);
  run_log_.emplace(log(), task_.start);
  return {};
}

void ExploreMissionNode::perceive_at(double time_s, std::optional<LaserScan> scan) {
  const auto odometry = frames().odom_T_robot(time_s);
  if (!odometry || is_over()) return;
  Observation seen;
  seen.time_s = std::max(0.0, time_s - began_s());
  seen.odometry = *odometry;
  seen.scan = std::move(scan);
  if (seen.scan) seen.scan->time_s = seen.time_s;
  mission_->perceive(seen);
  seen_s_ = time_s;
  if (seen.scan) run_log_->note_map(*mission_);
}

/// Lets the mission see the scan that waits, once its odometry is known.
void ExploreMissionNode::perceive_waiting() {
  if (!waiting_ || !frames().knows_odometry_at(*scans_.newest_s())) return;
  const sensor_msgs::LaserScan message = *std::exchange(waiting_, std::nullopt);
  const auto pose = frames().robot_T(message.header.frame_id);
  const auto mount = pose ? scan_mount(*pose)
                          : Outcome<ScanMount>(bad_input(
                                fmt::format("no transform says where '{}' is on '{}'",
                                            excerpt(message.header.frame_id), options().frames.base)));
  if (!mount) return tell(NodeLevel::warning, "scan: " + mount.error().sentence);
  if (!mission_) {
    if (auto ok = start(mount->robot_T_laser); !ok) return tell(NodeLevel::error, ok.error().sentence);
  }
  perceive_at(*scans_.newest_s(), scan_of(message, mount->upside_down, *scans_.newest_s()));
}

std::string ExploreMissionNode::why_to_stop() const {
  const std::string why = why_odometry_is_missing();
  return why.empty() ? why_missing("scan", scan_came_s_, options().patience_s) : why;
}

void ExploreMissionNode::drive() {
  if (*odometry_s() > seen_s_) perceive_at(*odometry_s(), std::nullopt);
  const std::optional<Command> next = mission_->respond();
  run_log_->note(*mission_, mission_->where().pose());
  if (!next) {
    finish();
    return;
  }
  const auto* twist = std::get_if<DriveTwist>(&*next);
  command(twist != nullptr ? twist->twist : Twist2{});
  set_status(NodeLevel::info, "exploring", mission_->decision().sentence);
}

void ExploreMissionNode::finish() {
  run_log_->finish(*mission_);
  const Box2 box = seen_box(mission_->where().slam().map().occupancy());
  info_.low = point_of(box.low);
  info_.high = point_of(box.high);
  log().append(topic::run, mission_->where().time_s(), info_);
  const bool good =
      mission_->stop_reason() == "complete" && (mission_->is_home() || !task_.rules.return_home);
  end(good ? NodeLevel::info : NodeLevel::error, mission_->stop_reason(),
      mission_->is_home() ? mission_->reason() + "; the robot is home" : mission_->reason());
}

void ExploreMissionNode::publish() {
  tf2_msgs::TFMessage transforms;
  const Pose2 map_T_odom =
      wrap_heading(compose(mission_->where().pose(), inverse(mission_->where().odometry())));
  transforms.transforms.push_back(
      transform_of(now_s(), map_T_odom, options().frames.map, options().frames.odom));
  send(transform_output_, transforms);
  const auto output = output_of(topic::map);
  if (!output || is_over() || now_s() - map_sent_s_ < map_period_s_) return;
  map_sent_s_ = now_s();
  send(*output, map_message(mission_->explored_map(), now_s(), options().frames.map));
}

void ExploreMissionNode::act() {
  if (is_over()) {
    command({});
    return;
  }
  const std::string why = why_to_stop();
  if (!why.empty() || !mission_) {
    if (!why.empty()) set_status(NodeLevel::error, mission_ ? "stopped" : "waiting", why);
    return command({});
  }
  drive();
  publish();
}

}  // namespace outrider
