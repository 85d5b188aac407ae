#include "outrider/log/messages/conversions.hpp"

#include <algorithm>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/log/log.hpp"

namespace outrider {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

}  // namespace

builtin_interfaces::Time stamp_of(double time_s) {
  const std::int64_t ns = nanoseconds(time_s);
  return {static_cast<std::int32_t>(ns / ns_per_s), static_cast<std::uint32_t>(ns % ns_per_s)};
}

std::int64_t nanoseconds_of(const builtin_interfaces::Time& stamp) {
  return stamp.sec * ns_per_s + stamp.nanosec;
}

std::int64_t nanoseconds_of(const std_msgs::Header& header, std::int64_t recorded_ns) {
  const std::int64_t stamp_ns = nanoseconds_of(header.stamp);
  return stamp_ns == 0 ? recorded_ns : stamp_ns;
}

std_msgs::Header header_of(double time_s, std::string frame) { return {stamp_of(time_s), std::move(frame)}; }

std::vector<outrider_msgs::Point2> points_of(const std::vector<Vec2>& points) {
  std::vector<outrider_msgs::Point2> result;
  result.reserve(points.size());
  for (const Vec2 point : points) result.push_back(point_of(point));
  return result;
}

std::vector<outrider_msgs::Outline> outlines_of(const std::vector<std::vector<Vec2>>& outlines) {
  std::vector<outrider_msgs::Outline> result;
  for (const auto& outline : outlines) result.push_back({points_of(outline)});
  return result;
}

std::vector<outrider_msgs::RoundedPolygon> rounded_of(const std::vector<RoundedPolygon>& shapes) {
  std::vector<outrider_msgs::RoundedPolygon> result;
  for (const RoundedPolygon& shape : shapes) result.push_back({points_of(shape.core), shape.radius_m});
  return result;
}

geometry_msgs::Quaternion quaternion_of(double heading_rad) {
  return {0.0, 0.0, std::sin(0.5 * heading_rad), std::cos(0.5 * heading_rad)};
}

double heading_of(const geometry_msgs::Quaternion& q) {
  const double heading_rad = std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
  return std::clamp(std::round(heading_rad / heading_step_rad) * heading_step_rad, -pi, pi);
}

Pose2 logged_pose(const Pose2& pose) {
  const double steps = std::trunc(wrap_angle(pose.heading_rad) / heading_step_rad);
  return {pose.position, steps * heading_step_rad};
}

geometry_msgs::Pose pose_of(const Pose2& pose) {
  return {{pose.position.x, pose.position.y, 0.0}, quaternion_of(pose.heading_rad)};
}

Pose2 pose_of(const geometry_msgs::Pose& pose) {
  return {{pose.position.x, pose.position.y}, heading_of(pose.orientation)};
}

geometry_msgs::PoseStamped stamped(double time_s, const Pose2& pose, std::string frame) {
  return {header_of(time_s, std::move(frame)), pose_of(pose)};
}

geometry_msgs::TransformStamped transform_of(double time_s, const Pose2& pose, std::string parent,
                                             std::string child) {
  return {header_of(time_s, std::move(parent)),
          std::move(child),
          {{pose.position.x, pose.position.y, 0.0}, quaternion_of(pose.heading_rad)}};
}

nav_msgs::Path path_of(double time_s, const std::vector<Vec2>& points, std::string frame) {
  nav_msgs::Path path{header_of(time_s, frame), {}};
  double heading_rad = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + 1 < points.size()) {
      const Vec2 way = points[i + 1] - points[i];
      if (way.x != 0.0 || way.y != 0.0) heading_rad = std::atan2(way.y, way.x);
    }
    path.poses.push_back(stamped(time_s, {points[i], heading_rad}, frame));
  }
  return path;
}

nav_msgs::Path path_of(const std::vector<double>& times_s, const std::vector<Pose2>& poses) {
  nav_msgs::Path path{header_of(times_s.empty() ? 0.0 : times_s.back(), "map"), {}};
  for (std::size_t i = 0; i < poses.size(); ++i) path.poses.push_back(stamped(times_s[i], poses[i]));
  return path;
}

}  // namespace outrider
