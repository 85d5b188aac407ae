// Conversions between the values of the library and the standard messages. Poses are in the plane z = 0.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/scene_messages.hpp"

namespace outrider {

/// Returns the time as ROS has it. Expects a time of at least 0 and below 2^31 s.
builtin_interfaces::Time stamp_of(double time_s);
/// Returns the time of a stamp, ns.
std::int64_t nanoseconds_of(const builtin_interfaces::Time& stamp);
/// Returns the time of the stamp in a header, ns, or that at which the message was recorded if it is 0.
std::int64_t nanoseconds_of(const std_msgs::Header& header, std::int64_t recorded_ns);
std_msgs::Header header_of(double time_s, std::string frame);

inline outrider_msgs::Point2 point_of(Vec2 at) { return {at.x, at.y}; }
inline Vec2 vec2_of(const outrider_msgs::Point2& at) { return {at.x, at.y}; }
inline geometry_msgs::Point point_of(const Vec3& at) { return {at.x, at.y, at.z}; }
inline geometry_msgs::Vector3 vector_of(const Vec3& v) { return {v.x, v.y, v.z}; }

std::vector<outrider_msgs::Point2> points_of(const std::vector<Vec2>& points);
std::vector<outrider_msgs::Outline> outlines_of(const std::vector<std::vector<Vec2>>& outlines);
std::vector<outrider_msgs::RoundedPolygon> rounded_of(const std::vector<RoundedPolygon>& shapes);

/// A rotation about z, counter-clockwise.
geometry_msgs::Quaternion quaternion_of(double heading_rad);
/// Headings that were read from a message are multiples of it. It is far above the rounding of a quaternion,
/// so that a heading that is a multiple of it is the same after it was logged and read.
inline constexpr double heading_step_rad = 0x1p-44;
/// Returns the heading of the x axis in the plane, from -pi to pi, in steps of `heading_step_rad`.
double heading_of(const geometry_msgs::Quaternion& rotation);
/// Returns the pose with its heading in [-pi, pi] and cut to a multiple of `heading_step_rad`: as it is read
/// from a message.
Pose2 logged_pose(const Pose2& pose);
geometry_msgs::Pose pose_of(const Pose2& pose);
Pose2 pose_of(const geometry_msgs::Pose& pose);
geometry_msgs::PoseStamped stamped(double time_s, const Pose2& pose, std::string frame = "map");
/// Returns the pose of the frame `child` in the frame `parent`.
geometry_msgs::TransformStamped transform_of(double time_s, const Pose2& pose, std::string parent,
                                             std::string child);
/// Returns a path through these points. Each pose looks to the next point; all have the time `time_s`.
nav_msgs::Path path_of(double time_s, const std::vector<Vec2>& points, std::string frame = "map");
/// A path of poses with their own times; `times_s` is as long as `poses`.
nav_msgs::Path path_of(const std::vector<double>& times_s, const std::vector<Pose2>& poses);

}  // namespace outrider
