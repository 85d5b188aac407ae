// Logs of the CARMEN toolkit: odometry and laser scans of a robot.
//
// Reads the lines "ODOM x y heading ..." and "FLASER n r1 .. rn x y heading x y heading time host time" (m,
// rad, s); skips all others. '#' starts a comment. The laser scans 180 degrees ahead, from right to left: n
// beams with a spacing of 180 / n degrees, or 180 / (n - 1) if n is odd. A reading is invalid if it is not a
// number or not below CarmenOptions::most_m, the value that the laser gives if it sees nothing.
//
// Corrected logs: in the published logs, the pose in a FLASER line is that of a finished map, and the ODOM
// lines before it are in the frame of the previous FLASER line. So the motion of step k is
//     (pose of FLASER k - 1)^-1 (last ODOM before FLASER k).
// This is the raw odometry, the only one that the robot had. The poses of the FLASER lines are returned
// separately, as a reference. If there is no ODOM line between two FLASER lines, the robot stood still. In a
// log without any ODOM line, the odometry is the differences of the FLASER poses, and there is no reference.
//
// Faults: bad_input with file:line. Bounds: 2,000,000 lines, 100,000 beams in a scan. Source: CARMEN, the
// Carnegie Mellon robot navigation toolkit (Montemerlo, Roy and Thrun, IROS 2003, 2436-2441), log format.
#pragma once

#include <vector>

#include "outrider/io/landmark_logs.hpp"
#include "outrider/slam/laser_scan.hpp"

namespace outrider {

struct LaserLogStep {
  Pose2 motion;  ///< pose relative to the previous scan, by odometry
  LaserScan scan;
};

struct LaserLog {
  std::vector<LaserLogStep> steps;
  std::vector<Pose2> reference;  ///< pose of each step in the corrected log; may be empty
};

struct CarmenOptions {
  double most_m = 32.0;  ///< readings of this range or more are invalid
};

std::vector<Option> describe(CarmenOptions& options);

Outcome<LaserLog> laser_log_from_carmen(const NamedText& log, const CarmenOptions& options);

/// Returns true if the text begins like one of these logs.
bool is_carmen_log(std::string_view text);

}  // namespace outrider
