// Functions that log what the devices of a robot measure, and where they are mounted.
#pragma once

#include <string>

#include "outrider/estimate/camera.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

/// Logs where a device is on the robot: the transform from "base_link" to the frame `device`. A device may be
/// mounted once.
void log_mount(Log& log, const std::string& device, const Pose2& robot_T_device, double height_m);

/// Returns the message of a camera in the frame "camera", without a time.
sensor_msgs::CameraInfo camera_message(const Camera& camera);

/// Logs the intrinsic parameters of a camera in the frame "camera".
void log_camera(Log& log, const Camera& camera);

/// Returns the message of a scan in the frame "laser", with that time in its header. A beam without return is
/// infinite.
sensor_msgs::LaserScan scan_message(const LaserScan& scan, double stamp_s);

/// Logs scan_message().
void log_scan(Log& log, double time_s, const LaserScan& scan);

/// Logs the pose of the robot by odometry alone.
void log_odometry(Log& log, double time_s, const Pose2& odom_T_robot);

}  // namespace outrider
