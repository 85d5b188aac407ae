#include "outrider/job/sensor_log.hpp"

#include <utility>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {

void log_mount(Log& log, const std::string& device, const Pose2& robot_T_device, double height_m) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(transform_of(0.0, robot_T_device, "base_link", device));
  transforms.transforms.back().transform.translation.z = height_m;
  log.append(topic::static_transforms, 0.0, std::move(transforms));
}

sensor_msgs::CameraInfo camera_message(const Camera& camera) {
  sensor_msgs::CameraInfo info;
  info.header = header_of(0.0, "camera");
  info.width = static_cast<std::uint32_t>(camera.width_px);
  info.height = static_cast<std::uint32_t>(camera.height_px);
  info.distortion_model = "plumb_bob";
  info.d.assign(camera.distortion.begin(), camera.distortion.end());
  info.k = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  info.r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.p = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

void log_camera(Log& log, const Camera& camera) { log.append(topic::camera, 0.0, camera_message(camera)); }

sensor_msgs::LaserScan scan_message(const LaserScan& scan, double stamp_s) {
  sensor_msgs::LaserScan message;
  message.header = header_of(stamp_s, "laser");
  const auto beams = static_cast<double>(scan.ranges_m.size());
  message.angle_min = static_cast<float>(scan.first_rad);
  message.angle_increment = static_cast<float>(scan.step_rad);
  message.angle_max = static_cast<float>(scan.first_rad + (beams - 1.0) * scan.step_rad);
  message.range_min = static_cast<float>(scan.least_m);
  message.range_max = static_cast<float>(scan.most_m);
  message.ranges = scan.ranges_m;
  return message;
}

void log_scan(Log& log, double time_s, const LaserScan& scan) {
  log.append(topic::scan, time_s, scan_message(scan, log.time_of(time_s)));
}

void log_odometry(Log& log, double time_s, const Pose2& odom_T_robot) {
  nav_msgs::Odometry message;
  message.header = header_of(log.time_of(time_s), "odom");
  message.child_frame_id = "base_link";
  message.pose.pose = pose_of(odom_T_robot);
  log.append(topic::odometry, time_s, std::move(message));
}

}  // namespace outrider
