// The mount of a laser on its robot, and the scans that it sends from there.
#pragma once

#include <cstdint>

#include "outrider/geometry/pose.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

/// The mount of a level laser.
struct ScanMount {
  Pose2 robot_T_laser;
  bool upside_down = false;  ///< its angles count clockwise, as seen from above
};

/// Returns the mount. Fault: bad_input with the tilt, if the laser is not level within 15 degrees.
Outcome<ScanMount> scan_mount(const Pose3& robot_T_laser);

/// Returns the scan with its beams counter-clockwise, as seen from above, and no reading outside of its
/// limits.
LaserScan scan_of(const sensor_msgs::LaserScan& message, bool upside_down, double time_s);

}  // namespace outrider
