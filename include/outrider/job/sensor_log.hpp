// Functions that log what the devices of a robot measure, and where they are mounted.
#pragma once

#include <string>

#include "outrider/estimate/camera.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/log/log.hpp"
#include "outrider/slam/laser_scan.hpp"

namespace outrider {

/// Logs where a device is on the robot: the transform from "base_link" to the frame `device`. A device may be
/// mounted once.
void log_mount(Log& log, const std::string& device, const Pose2& robot_T_device, double height_m);

/// Logs the intrinsic parameters of a camera in the frame "camera".
void log_camera(Log& log, const Camera& camera);

/// Logs a scan in the frame "laser". A beam without return is infinite.
void log_scan(Log& log, double time_s, const LaserScan& scan);

/// Logs the pose of the robot by odometry alone.
void log_odometry(Log& log, double time_s, const Pose2& odom_T_robot);

}  // namespace outrider
