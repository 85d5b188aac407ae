#include "outrider/nodes/mapper_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/io/log/scan_mount.hpp"
#include "outrider/jobs/explore/map/map_doubt.hpp"
#include "outrider/jobs/explore/mission/task.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_waiting = 10;              // scans
constexpr double drove_m = 0.003, turned_rad = 0.01;  // between two scans; less is noise

}  // namespace

MapperNodeOptions::MapperNodeOptions() : slam(near_sighted_slam()) {}

std::vector<OptionGroup> describe(MapperNodeOptions& options) {
  return {
      {"",
       "the map",
       {{"map_period", "s", 0.0, 1e6, "the map is sent at most so often", &options.map_period_s},
        {"patience", "s", 0.05, 1e6, "without a scan, after which it no longer says where the robot is",
         &options.patience_s},
        file_option(
            "keep",
            "YAML file in which the map is kept, and from which a mapper goes on that is started anew",
            &options.keep),
        {"keep_period", "s", 0.1, 1e6, "the files are written at most so often", &options.keep_period_s}}},
      {"frame", "names of the frames", describe(options.frames)},
      {"slam", "how it knows where it is", describe(options.slam)},
      {"occupancy", "the map that it makes", describe(options.slam.map)}};
}

Outcome<MapperNodeOptions> MapperNode::checked(MapperNodeOptions options) {
  if (options.keep.empty()) return options;
  if (!options.keep.ends_with(".yaml")) return bad_input("give a name that ends in .yaml", "keep");
  auto kept = load_kept_map(options.keep);
  if (!kept) return pass_on(kept);
  if (*kept && (*kept)->occupancy.frame.resolution_m != options.slam.map.resolution_m) {
    return bad_input(fmt::format("its cells have {:g} m, and those of this mapper {:g} m; give the same, or "
                                 "another file",
                                 (*kept)->occupancy.frame.resolution_m, options.slam.map.resolution_m),
                     options.keep);
  }
  return options;
}

MapperNode::MapperNode(MapperNodeOptions options)
    : Node("mapper", 0.05), options_(std::move(options)), frames_(options_.frames) {
  listen<sensor_msgs::LaserScan>("scan", Delivery::sensor,
                                 [this](const auto& scan) { return take_scan(scan); });
  listen<nav_msgs::Odometry>("odom", Delivery::sensor,
                             [this](const auto& odometry) { return take_odometry(odometry); });
  listen_to_transforms(frames_);
  map_output_ = add_output<nav_msgs::OccupancyGrid>("map", Delivery::latched);
  pose_output_ = add_output<geometry_msgs::PoseWithCovarianceStamped>("pose", Delivery::reliable);
  transform_output_ = add_output<tf2_msgs::TFMessage>("/tf", Delivery::reliable);
  set_status(NodeLevel::info, "waiting", "no scan has come yet");
  if (options_.keep.empty()) return;
  if (auto kept = load_kept_map(options_.keep)) kept_ = std::move(*kept);
}

/// Begins a map, or goes on with the one that was kept.
Status MapperNode::begin(const Pose2& odometry, const LaserScan& scan, double time_s) {
  Pose2 start = odometry;
  begun_s_ = time_s;
  const auto place = kept_ ? place_on(*kept_, odometry, scan, options_.slam) : std::nullopt;
  if (place) {
    start = *place;
    begun_s_ = kept_->begun_s;
    tell(NodeLevel::info, "the kept map fits; it goes on with it");
  } else if (kept_) {
    kept_.reset();
    tell(NodeLevel::warning,
         "the scan does not fit the kept map where the odometry says that the robot is; "
         "another map begins");
  }
  if (place && !kept_->scans.empty()) return go_on(*place, odometry);
  auto begun = LaserSlam::begin(options_.slam, start);
  if (!begun) return pass_on(begun);
  slam_ = std::move(*begun);
  odometry_ = odometry;
  return {};
}

/// Maps the scans that were kept once more; the next one was taken at `place` on their map.
Status MapperNode::go_on(const Pose2& place, const Pose2& odometry) {
  auto begun = LaserSlam::begin(options_.slam, kept_->scans.front().map_T_robot);
  if (!begun) return pass_on(begun);
  slam_ = std::move(*begun);
  Pose2 before = kept_->scans.front().map_T_robot;
  for (const KeptScan& kept : kept_->scans) {
    if (auto step = advance(wrap_heading(relative_pose(before, kept.map_T_robot)), kept.scan); !step)
      return pass_on(step);
    before = kept.map_T_robot;
  }
  odometry_ = compose(odometry, inverse(relative_pose(before, place)));
  return {};
}

Outcome<LaserSlamStep> MapperNode::advance(const Pose2& motion, const LaserScan& scan) {
  auto step = slam_->advance(motion, scan);
  if (!step) return step;
  ++steps_;
  if (step->kept && !options_.keep.empty()) keyframes_.emplace_back(steps_, scan);
  return step;
}

/// Returns the keyframes where they are by now.
std::vector<KeptScan> MapperNode::kept_scans() const {
  const std::vector<Pose2> poses = slam_->trajectory();
  std::vector<KeptScan> scans;
  scans.reserve(keyframes_.size());
  for (const auto& [step, scan] : keyframes_) scans.push_back({poses[step], scan});
  return scans;
}

Status MapperNode::take_scan(const sensor_msgs::LaserScan& scan) {
  const auto time_s = scans_.take(scan.header.stamp);
  if (!time_s) return pass_on(time_s);
  if (auto ok = check(scan_of(scan, false, *time_s)); !ok) return ok;
  if (waiting_.size() == most_waiting) waiting_.pop_front();
  waiting_.push_back({*time_s, scan});
  map_waiting();
  return {};
}

Status MapperNode::take_odometry(const nav_msgs::Odometry& odometry) {
  if (auto time_s = odometries_.take(odometry.header.stamp); !time_s) return pass_on(time_s);
  if (auto ok = frames_.add(odometry); !ok) return ok;
  map_waiting();
  return {};
}

/// Maps the scans whose odometry has come.
void MapperNode::map_waiting() {
  while (!waiting_.empty() && frames_.knows_odometry_at(waiting_.front().time_s)) {
    const Waiting first = std::move(waiting_.front());
    waiting_.pop_front();
    if (auto ok = map(first); !ok) tell(NodeLevel::warning, "scan: " + printable(ok.error().sentence));
  }
}

Status MapperNode::map(const Waiting& waiting) {
  const auto mount = frames_.robot_T(waiting.scan.header.frame_id);
  if (!mount) {
    return bad_input(
        fmt::format("no transform says where '{}' is on '{}'; the scans wait for it on /tf_static",
                    excerpt(waiting.scan.header.frame_id), options_.frames.base));
  }
  const auto level = scan_mount(*mount);
  if (!level) return pass_on(level);
  const auto odometry = frames_.odom_T_robot(waiting.time_s);
  if (!odometry) return bad_input("its odometry is not finite");
  const LaserScan scan = scan_of(waiting.scan, level->upside_down, waiting.time_s);
  if (!slam_) {
    options_.slam.robot_T_laser = level->robot_T_laser;
    if (auto ok = begin(*odometry, scan, waiting.time_s); !ok) return ok;
  }
  const Pose2 motion = wrap_heading(relative_pose(odometry_, *odometry));
  auto step = advance(motion, scan);
  if (!step) return pass_on(step);
  odometry_ = *odometry;
  map_T_odom_ = wrap_heading(compose(step->pose, inverse(odometry_)));
  mapped_s_ = now_s();
  map_changed_ = true;
  if (norm(motion.position) > drove_m || std::abs(motion.heading_rad) > turned_rad) {
    drove_s_ = now_s();
    judged_ = false;
  }
  if (step->closed_loop) {
    tell(NodeLevel::info, "a place was recognised, and the map was redrawn");
    if (kept_ && !kept_->scans.empty()) kept_->occupancy = Grid<std::uint8_t>();
  }
  if (step->lost) tell(NodeLevel::warning, "the robot is lost: its scan fits several places or none");
  send_pose(waiting.time_s);
  return {};
}

void MapperNode::send_pose(double time_s) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header = header_of(time_s, options_.frames.map);
  message.pose.pose = pose_of(slam_->pose());
  const Eigen::Matrix3d covariance = slam_->pose_covariance();
  constexpr std::array<std::size_t, 3> axes{0, 1, 5};  // x, y and the rotation about z
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      message.pose.covariance[axes[row] * 6 + axes[column]] =
          covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    }
  }
  send(pose_output_, message);
}

void MapperNode::send_map() {
  const Grid<std::uint8_t>& seen = slam_->map().occupancy();
  const bool others = kept_ && !kept_->occupancy.cells.empty();
  const Grid<std::uint8_t> map = others ? overlaid(kept_->occupancy, seen) : seen;
  send(map_output_, map_message(map, now_s(), options_.frames.map, begun_s_));
  map_sent_s_ = now_s();
  map_changed_ = false;
  if (options_.keep.empty() || now_s() - kept_s_ < options_.keep_period_s) return;
  kept_s_ = now_s();
  if (auto ok = save(options_.keep, {map, begun_s_, map_T_odom_, kept_scans()}); !ok)
    tell(NodeLevel::warning, "the map was not kept: " + to_string(ok.error()));
}

/// Asks whether the map can be believed. O(keyframes^2 + beams of the keyframes).
void MapperNode::judge() {
  constexpr double stands_s = 1.0;
  constexpr std::size_t least_steps = 250;
  const bool stands = now_s() - drove_s_ >= stands_s;
  const bool grown = steps_ >= std::max(least_steps, judged_steps_ + judged_steps_ / 2);
  if (judged_ || !(stands || grown)) return;
  doubt_ = map_doubt(*slam_);
  judged_ = stands;
  judged_steps_ = steps_;
}

void MapperNode::act() {
  if (!mapped_s_) {
    if (!waiting_.empty()) set_status(NodeLevel::warning, "waiting", "a scan waits for its odometry");
    return;
  }
  const double blind_s = now_s() - *mapped_s_;
  if (blind_s > options_.patience_s) {
    set_status(NodeLevel::error, "blind",
               fmt::format("no scan with odometry has come for {:g} s", options_.patience_s));
    return;
  }
  judge();
  if (doubt_.empty())
    set_status(NodeLevel::info, "mapping", "scans are mapped");
  else
    set_status(NodeLevel::warning, "doubtful", doubt_);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(
      transform_of(now_s(), map_T_odom_, options_.frames.map, options_.frames.odom));
  send(transform_output_, transforms);
  if (map_changed_ && now_s() - map_sent_s_ >= options_.map_period_s) send_map();
}

}  // namespace outrider
