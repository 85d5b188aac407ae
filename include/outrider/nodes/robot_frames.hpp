// RobotFrames: where the robot is, from the transforms that nodes exchange: map -> odom -> robot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/log/transform_buffer.hpp"

namespace outrider {

/// Names of the frames (REP 105).
struct FrameNames {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";
};
std::vector<Option> describe(FrameNames& names);

/// Returns the pose in the plane.
Pose2 in_plane(const Pose3& pose);

class RobotFrames {
 public:
  explicit RobotFrames(FrameNames names) : names_(std::move(names)) {}

  /// Takes a message of /tf or /tf_static that came at that time. Fault: that of TransformBuffer::add().
  Status add(const tf2_msgs::TFMessage& message, Transforms kind, double time_s);
  /// Takes odometry as the transform from its frame to the robot. Fault: for poses that are not finite.
  Status add(const nav_msgs::Odometry& odometry);

  [[nodiscard]] const FrameNames& names() const { return names_; }
  /// Returns the newest pose of the robot on the map, or in the frame of its odometry; nothing if it is not
  /// known.
  [[nodiscard]] std::optional<Pose2> map_T_robot() const;
  [[nodiscard]] std::optional<Pose2> odom_T_robot(double time_s) const;
  [[nodiscard]] std::optional<Pose2> map_T_odom() const;
  /// Returns the pose of a device on the robot.
  [[nodiscard]] std::optional<Pose3> robot_T(const std::string& device) const;
  /// Returns true if the odometry is known up to that time.
  [[nodiscard]] bool knows_odometry_at(double time_s) const;
  /// Returns when map -> odom came last, by the time of the node; nothing before.
  [[nodiscard]] std::optional<double> localised_s() const { return localised_s_; }

 private:
  FrameNames names_;
  TransformBuffer buffer_;
  std::optional<double> localised_s_;
};

}  // namespace outrider
