// Open loop: turn towards the next waypoint, go straight, turn to its heading, each timed beforehand.
//
// Each motion is steady, lasts as long as the laws of the calibration say it takes, and is followed by a
// rest, so that all begin and end at rest. Nothing is sensed: errors add up. O(waypoints).
#pragma once

#include <vector>

#include "outrider/control/calibration.hpp"

namespace outrider {

struct TimedMotion {
  Twist2 twist;              ///< as the body shall move, calibration included
  double duration_s = 0.0;   ///< for which it is commanded
  double rest_s = 0.0;       ///< after it
  bool at_waypoint = false;  ///< the last motion to a waypoint
};

struct TimedDriveOptions {
  double speed_mps = 0.2;
  double turn_rate_radps = 0.6;
  double rest_s = 1.0;
};

/// Three motions a waypoint; one that has nothing to do lasts 0 s. Turns take the shorter way.
std::vector<TimedMotion> timed_drive(const Pose2& start, const std::vector<Pose2>& waypoints,
                                     const TimedDriveOptions& options, const Calibration& calibration);

}  // namespace outrider
