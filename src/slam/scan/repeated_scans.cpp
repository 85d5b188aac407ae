#include "outrider/slam/scan/repeated_scans.hpp"

#include "outrider/core/units.hpp"

namespace outrider {

bool RepeatedScans::repeats(const LaserScan& scan, const Pose2& odometry) {
  constexpr double moved_m = 0.02, turned_rad = 0.02;
  if (scan.ranges_m != ranges_m_) {
    ranges_m_ = scan.ranges_m;
    odometry_ = odometry;
    return false;
  }
  const Pose2 since = relative_pose(odometry_, odometry);
  return norm(since.position) > moved_m || std::abs(wrap_angle(since.heading_rad)) > turned_rad;
}

}  // namespace outrider
