// closest_approach: how near robots that drive at the same time come to each other.
//
// It is for verifying drives of several robots, and shares no code with what plans or simulates them: it has
// its own formulas of the motion. A robot turns in place towards each waypoint and drives straight to it,
// from rest to rest, as RobotModel limits it; between two drives, and after the last, it stands. So its
// position is a polynomial of the second degree in time, piece by piece, and the squared distance of two
// robots one of the fourth. Its least value on each piece is at an end or where the derivative, a cubic, is
// zero; all zeros are found. Nothing is sampled. Level ground only.
//
// Frames and units: world, metres, seconds, radians.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/robot_model.hpp"

namespace outrider {

/// A drive with its time.
struct TimedDrive {
  double begin_s = 0.0;         ///< the first turn begins
  std::vector<Vec2> waypoints;  ///< the first is where the robot stands
  /// Heading before the first turn; unset: that in which the drive before ended. A robot whose drives end
  /// with an error of the heading has another one.
  std::optional<double> heading_rad = {};
};

/// The drives of one robot.
struct TimedDrives {
  Pose2 start;                     ///< pose at time 0
  std::vector<TimedDrive> drives;  ///< in the order of time
};

/// The moment at which two robots are nearest to each other.
struct ClosestApproach {
  double distance_m = 0.0;  ///< between the centres; infinite if there are fewer than two robots
  double time_s = 0.0;      ///< the first such time
  std::size_t one = 0;      ///< index of a robot
  std::size_t other = 0;    ///< index of the other robot, above `one`
};

/// Returns the closest approach of all pairs, to about 1e-9 m. Fault: bad_input, with the robot and the drive
/// as both count from 1, for a drive that begins before the one before has ended or elsewhere than the robot
/// stands (by more than 1e-6), and for numbers that are not finite. O(robots^2 * waypoints).
Outcome<ClosestApproach> closest_approach(const RobotModel& robot, const std::vector<TimedDrives>& robots);

}  // namespace outrider
