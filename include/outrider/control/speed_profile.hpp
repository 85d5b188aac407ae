// SpeedProfile: the fastest speeds along a given path under limits of speed and acceleration, from rest to
// rest.
//
// With x the square of the speed along the path and u = dx/ds / 2 the acceleration along it, every limit is
// convex in (u, x):
//   speed           x <= speed^2, and of the turn rate and of each wheel, which are proportional to it
//   acceleration    u^2 + (curvature x)^2 <= acceleration^2, of the centre
//   turning         |curvature u + curvature' x| <= turn acceleration, for a robot that points along the path
// A backward pass computes for each point the largest x from which the rest of the path can be driven, a
// forward pass takes at each point the largest u that keeps x below it. The result is time-optimal for
// constant u between points: Pham and Pham, A new approach to time-optimal path parameterization based on
// reachability analysis (IEEE Transactions on Robotics, 2018); Bobrow, Dubowsky and Gibson, Time-optimal
// control of robotic manipulators along specified paths (1985). O(points).
#pragma once

#include <limits>
#include <vector>

#include "outrider/control/rounded_path.hpp"

namespace outrider {

/// Limits of a robot on a path.
struct PathLimits {
  double speed_mps = 1.0;                 ///< > 0
  double acceleration_mps2 = 1.0;         ///< > 0
  bool turns_with_path = false;           ///< the robot points along the path: the rest applies
  double turn_rate_radps = 1.0;           ///< > 0
  double turn_acceleration_radps2 = 1.0;  ///< > 0
  /// A wheel turns at most at `per_speed` times the speed plus `per_turn` times the turn rate.
  double wheel_radps = std::numeric_limits<double>::infinity();
  double per_speed = 0.0;
  double per_turn = 0.0;
};

/// Speeds and times at the points of a path.
struct SpeedProfile {
  std::vector<double> speeds_mps;
  std::vector<double> times_s;  ///< since the start
};

/// Returns the profile of a path that has at least two points.
SpeedProfile speed_profile(const std::vector<PathPoint>& path, const PathLimits& limits);

/// Returns the largest speed at a point, m/s, whatever comes before and behind it. `curvature_per_m` is the
/// derivative of the curvature along the path, 1/m^2.
double greatest_speed(double curvature, double curvature_per_m, const PathLimits& limits);

}  // namespace outrider
