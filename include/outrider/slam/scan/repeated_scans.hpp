// RepeatedScans: a sensor that is frozen repeats its ranges exactly, although the wheels have moved.
#pragma once

#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

class RepeatedScans {
 public:
  /// Returns true if the scan has exactly the ranges of the one before, and the robot has moved by 2 cm or
  /// 0.02 rad by odometry since the first scan with these ranges. O(beams).
  bool repeats(const LaserScan& scan, const Pose2& odometry);

 private:
  std::vector<float> ranges_m_;  ///< of the newest scan
  Pose2 odometry_;               ///< at the first scan with these ranges
};

}  // namespace outrider
