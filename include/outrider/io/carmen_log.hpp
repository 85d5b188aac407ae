// Logs of the CARMEN toolkit: what a robot with a laser wrote down.
//
// Lines read: "ODOM x y heading ..." and "FLASER n r1 .. rn x y heading x y heading time host time" (m, rad,
// s); others are passed over, and so is what follows '#'. The laser looks over 180 degrees ahead, from right
// to left: n beams at 180 / n degrees, or 180 / (n - 1) where n is odd. A reading that is no number, or is as
// far as the laser says it can see nothing, is no reading.
//
// Corrected logs: in the published logs the pose of FLASER is that of a finished map, and the ODOM lines
// before it stand in the frame of the FLASER before. So the motion of step k is
// (pose of FLASER k - 1)^-1 (last ODOM before FLASER k): the raw odometry, which is all that a robot had. The
// poses of the FLASER lines are kept apart, to compare with. Where no ODOM stands between two FLASER, the
// robot stood still; a log without any ODOM has the differences of the FLASER poses for odometry, and no
// reference.
//
// Errors: bad_input with file:line. Bounds: 2,000,000 lines, 100,000 beams in a scan. Source: CARMEN, the
// Carnegie Mellon robot navigation toolkit (Montemerlo, Roy and Thrun, IROS 2003, 2436-2441), log format.
#pragma once

#include <vector>

#include "outrider/io/landmark_logs.hpp"
#include "outrider/slam/laser_scan.hpp"

namespace outrider {

struct LaserLogStep {
  Pose2 motion;  ///< the robot at the scan in its frame at the scan before, by odometry
  LaserScan scan;
};

struct LaserLog {
  std::vector<LaserLogStep> steps;
  std::vector<Pose2> reference;  ///< the pose of each step that whoever corrected the log gave; or empty
};

struct CarmenOptions {
  double most_m = 32.0;  ///< readings from here on say nothing
};

std::vector<Option> describe(CarmenOptions& options);

Outcome<LaserLog> laser_log_from_carmen(const NamedText& log, const CarmenOptions& options);

/// Returns true if the text begins like one of these logs.
bool is_carmen_log(std::string_view text);

}  // namespace outrider
