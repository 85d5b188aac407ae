#include "outrider/nodes/robot_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/log/log.hpp"
#include "outrider/nodes/messages/checked.hpp"

namespace outrider {
namespace {

constexpr std::int64_t newest_ns = std::numeric_limits<std::int64_t>::max();

constexpr double most_ahead_s = 10.0;

std::string without_slash(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

std::optional<Pose2> plane(const std::optional<Pose3>& pose) {
  constexpr double most_m = 1e6;  // what is farther is on no map
  if (!pose) return std::nullopt;
  const Pose2 flat = in_plane(*pose);
  if (!finite(flat) || !(norm(flat.position) <= most_m)) return std::nullopt;
  return flat;
}

}  // namespace

std::vector<Option> describe(FrameNames& names) {
  return {{"map", "", 0, 0, "frame of the map", &names.map},
          {"odom", "", 0, 0, "frame of the odometry", &names.odom},
          {"base", "", 0, 0, "frame of the robot", &names.base}};
}

Pose2 in_plane(const Pose3& pose) {
  const Vec3 ahead = pose.rotation.axes[0];
  return {{pose.position.x, pose.position.y}, std::atan2(ahead.y, ahead.x)};
}

Status RobotFrames::add(const tf2_msgs::TFMessage& message, Transforms kind, double time_s) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    auto stamp_s = time_of(transform.header.stamp);
    if (!stamp_s) return pass_on(stamp_s);
    if (kind == Transforms::moving && *stamp_s > time_s + most_ahead_s) {
      return bad_input(fmt::format(
          "its stamp is {:.1f} s ahead of the time of this node; do both take the simulated time?",
          *stamp_s - time_s));
    }
  }
  if (auto ok = buffer_.add(message, kind); !ok) return ok;
  const bool localised = std::ranges::any_of(message.transforms, [&](const auto& transform) {
    return without_slash(transform.header.frame_id) == names_.map &&
           without_slash(transform.child_frame_id) == names_.odom;
  });
  if (localised) localised_s_ = time_s;
  return {};
}

Status RobotFrames::add(const nav_msgs::Odometry& odometry) {
  auto time = time_of(odometry.header.stamp);
  if (!time) return pass_on(time);
  auto pose = plane_pose(odometry.pose.pose);
  if (!pose) return pass_on(pose);
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  geometry_msgs::TransformStamped& transform = message.transforms.front();
  transform.header.stamp = odometry.header.stamp;
  transform.header.frame_id = names_.odom;
  transform.child_frame_id = names_.base;
  transform.transform.translation = {odometry.pose.pose.position.x, odometry.pose.pose.position.y, 0.0};
  transform.transform.rotation = odometry.pose.pose.orientation;
  return buffer_.add(message, Transforms::moving);
}

std::optional<Pose2> RobotFrames::map_T_robot() const {
  return plane(buffer_.find(names_.map, names_.base, newest_ns));
}

std::optional<Pose2> RobotFrames::odom_T_robot(double time_s) const {
  return plane(buffer_.find(names_.odom, names_.base, nanoseconds(time_s)));
}

std::optional<Pose2> RobotFrames::map_T_odom() const {
  return plane(buffer_.find(names_.map, names_.odom, newest_ns));
}

std::optional<Pose3> RobotFrames::robot_T(const std::string& device) const {
  return buffer_.find(names_.base, device, newest_ns);
}

bool RobotFrames::knows_odometry_at(double time_s) const {
  const auto until_ns = buffer_.known_until_ns(names_.odom, names_.base);
  return until_ns && *until_ns >= nanoseconds(time_s);
}

}  // namespace outrider
