// Open-loop driving: the robot turns towards the next waypoint, drives straight, and turns to the heading of
// the waypoint. The duration of each motion is computed in advance.
//
// Each motion has a constant twist and the duration that the calibration predicts. It begins and ends at
// rest, with a pause after it. There is no feedback, so errors accumulate. O(waypoints).
#pragma once

#include <vector>

#include "outrider/control/calibration.hpp"

namespace outrider {

/// One motion with a constant command.
struct TimedMotion {
  Twist2 twist;              ///< commanded twist, with the calibration applied
  double duration_s = 0.0;   ///< duration of the command
  double rest_s = 0.0;       ///< pause after the motion
  bool at_waypoint = false;  ///< this is the last motion to a waypoint
};

/// Options of timed_drive().
struct TimedDriveOptions {
  double speed_mps = 0.2;        ///< speed of straight motions
  double turn_rate_radps = 0.6;  ///< rate of turns
  double rest_s = 1.0;           ///< pause after each motion
};

/// Returns three motions for each waypoint; a motion that is not needed has a duration of 0 s. Turns take the
/// shorter direction.
std::vector<TimedMotion> timed_drive(const Pose2& start, const std::vector<Pose2>& waypoints,
                                     const TimedDriveOptions& options, const Calibration& calibration);

}  // namespace outrider
