// How uncertain a motion is that was measured by odometry.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {

/// Standard deviations of a motion measured by odometry.
struct MotionNoise {
  double position_m = 0.0;
  double heading_rad = 0.0;

  [[nodiscard]] Eigen::Matrix3d information() const {
    const double p = 1.0 / (position_m * position_m);
    return Eigen::Vector3d(p, p, 1.0 / (heading_rad * heading_rad)).asDiagonal();
  }
};

/// Distance driven and sum of turns.
struct Driven {
  double way_m = 0.0;
  double turn_rad = 0.0;

  [[nodiscard]] bool is_zero() const { return way_m == 0.0 && turn_rad == 0.0; }
  Driven& operator+=(const Pose2& motion) {
    way_m += norm(motion.position);
    turn_rad += std::abs(motion.heading_rad);
    return *this;
  }
};

/// Returns the standard deviations. The error of the heading also moves the position sideways.
inline MotionNoise odometry_noise(const Driven& driven, const LaserSlamOptions& o) {
  const double root_m = std::sqrt(driven.way_m);
  const double heading_rad = std::hypot(o.odometry_rest_rad, o.odometry_turn * std::sqrt(driven.turn_rad),
                                        o.odometry_turn_per_distance_rad * root_m);
  const double aside_m = heading_rad * driven.way_m / std::sqrt(3.0);
  return {std::hypot(o.odometry_rest_m, o.odometry_distance * root_m, aside_m), heading_rad};
}

}  // namespace outrider
