// A keyframe of a laser map: a pose that the map is drawn from, and its scan.
#pragma once

#include "motion_noise.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

struct Keyframe {
  Pose2 pose;          ///< world_T_robot
  double way_m = 0.0;  ///< distance driven up to here
  LaserScan scan;      ///< without ranges once it was released

  Pose2 odometry{};                      ///< its pose on the keyframe before, by odometry
  MotionNoise odometry_noise{1.0, 1.0};  ///< of that pose
  double pause_s = 0.0;                  ///< longest time without a scan since the keyframe before
  double shared_before = 1.0;  ///< share of its surface that the keyframe before shows too, when added

  Pose2 counted{};  ///< `odometry` without what was learned of its errors

  [[nodiscard]] bool has_scan() const { return !scan.ranges_m.empty(); }
  /// Frees the memory of the scan.
  void release_scan() { scan.ranges_m = std::vector<float>(); }  // "= {}" would keep the memory
};

}  // namespace outrider
