#include "outrider/io/log/scan_mount.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/geometry/spatial_pose.hpp"

namespace outrider {

Outcome<ScanMount> scan_mount(const Pose3& robot_T_laser) {
  constexpr double most_tilt_rad = radians(15.0);
  const double up = robot_T_laser.rotation.axes[2].z;  // of the axis that the laser turns about
  const double tilt_rad = std::acos(std::clamp(std::abs(up), 0.0, 1.0));
  if (!(tilt_rad <= most_tilt_rad)) {
    return bad_input(
        fmt::format("the laser is tilted by {:.0f} degrees on the robot; only a level one maps a floor",
                    degrees(tilt_rad)));
  }
  return ScanMount{plan_pose(robot_T_laser), up < 0.0};
}

LaserScan scan_of(const sensor_msgs::LaserScan& message, bool upside_down, double time_s) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const double sign = upside_down ? -1.0 : 1.0;
  LaserScan scan{time_s,
                 sign * static_cast<double>(message.angle_min),
                 sign * static_cast<double>(message.angle_increment),
                 static_cast<double>(message.range_min),
                 static_cast<double>(message.range_max),
                 message.ranges};
  for (float& range_m : scan.ranges_m) {
    const bool beyond = range_m > message.range_max && !std::isinf(range_m);
    if (beyond || range_m < message.range_min) range_m = none;
  }
  if (scan.step_rad < 0.0 && !scan.ranges_m.empty()) {
    scan.first_rad += static_cast<double>(scan.ranges_m.size() - 1) * scan.step_rad;
    scan.step_rad = -scan.step_rad;
    std::ranges::reverse(scan.ranges_m);
  }
  return scan;
}

}  // namespace outrider
