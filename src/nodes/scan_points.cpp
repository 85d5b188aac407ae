#include "outrider/nodes/scan_points.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/core/text.hpp"
#include "outrider/io/log/scan_mount.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

Status ScanPoints::take(const sensor_msgs::LaserScan& message, const RobotFrames& frames, double now_s) {
  const std::optional<double> before_s = stamps_.newest_s();
  const auto time_s = stamps_.take(message.header.stamp);
  if (!time_s) return pass_on(time_s);
  const auto mount_pose = frames.robot_T(message.header.frame_id);
  if (!mount_pose) {
    return bad_input(fmt::format("no transform says where '{}' is on '{}'", excerpt(message.header.frame_id),
                                 frames.names().base));
  }
  const auto mount = scan_mount(*mount_pose);
  if (!mount) return pass_on(mount);
  const LaserScan scan = scan_of(message, mount->upside_down, *time_s);
  if (auto ok = check(scan); !ok) return ok;
  points_.clear();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    const bool counts = range_m >= scan.least_m && range_m <= std::min(scan.most_m, most_m_);
    if (!counts) continue;
    const double bearing = scan.first_rad + static_cast<double>(i) * scan.step_rad;
    points_.push_back(mount->robot_T_laser * (range_m * direction(bearing)));
  }
  time_s_ = *time_s;
  if (before_s != *time_s) came_s_ = now_s;  // the same once more is not new
  return {};
}

}  // namespace outrider
