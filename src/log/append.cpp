#include "outrider/log/append.hpp"

#include <utility>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {

void log_pose(Log& log, double time_s, const Pose2& pose) {
  log.append(topic::pose, time_s, stamped(log.time_of(time_s), pose));
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(transform_of(log.time_of(time_s), pose, "map", "base_link"));
  log.append(topic::transforms, time_s, std::move(transforms));
}

void log_belief(Log& log, double time_s, const Pose2& pose, const Eigen::Matrix3d& covariance,
                bool corrected) {
  geometry_msgs::PoseWithCovarianceStamped belief;
  belief.header = header_of(log.time_of(time_s), "map");
  belief.pose.pose = pose_of(pose);
  constexpr int axes[] = {0, 1, 5};  // x, y and the rotation about z among the six of the message
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      belief.pose.covariance[static_cast<std::size_t>(6 * axes[row] + axes[column])] =
          covariance(row, column);
    }
  }
  log.append(topic::belief, time_s, std::move(belief));
  if (corrected) log.append(topic::corrections, time_s, stamped(log.time_of(time_s), pose));
}

void log_plan(Log& log, double time_s, const std::vector<Vec2>& points) {
  log.append(topic::plan, time_s, path_of(log.time_of(time_s), points));
}

void log_gun(Log& log, double time_s, double yaw_rad, double pitch_rad) {
  sensor_msgs::JointState joints;
  joints.header = header_of(log.time_of(time_s), "base_link");
  joints.name = {"gun_yaw", "gun_pitch"};
  joints.position = {yaw_rad, pitch_rad};
  log.append(topic::joints, time_s, std::move(joints));
}

void log_event(Log& log, double time_s, std::string kind, std::string sentence) {
  rcl_interfaces::Log line;
  line.stamp = stamp_of(log.time_of(time_s));
  line.name = std::move(kind);
  line.msg = std::move(sentence);
  log.append(topic::events, time_s, std::move(line));
}

std::vector<Stamped<rcl_interfaces::Log>> events_of(const Log& log, std::string_view kind) {
  std::vector<Stamped<rcl_interfaces::Log>> events;
  for (const auto& event : log.messages<rcl_interfaces::Log>(topic::events)) {
    if (kind.empty() || event.message.name == kind) events.push_back(event);
  }
  return events;
}

std::vector<Pose2> poses_of(const Log& log) {
  std::vector<Pose2> poses;
  for (const auto& pose : log.messages<geometry_msgs::PoseStamped>(topic::pose))
    poses.push_back(pose_of(pose.message.pose));
  return poses;
}

void log_footprint(Log& log, const std::vector<Vec2>& outline) {
  geometry_msgs::PolygonStamped message{header_of(0.0, "base_link"), {}};
  for (const Vec2 corner : outline)
    message.polygon.points.push_back({static_cast<float>(corner.x), static_cast<float>(corner.y), 0.0F});
  log.append(topic::footprint, 0.0, std::move(message));
}

}  // namespace outrider
