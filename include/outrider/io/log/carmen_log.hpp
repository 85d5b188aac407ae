// Logs of the CARMEN toolkit: odometry and laser scans of a robot.
//
// Reads the lines "ODOM x y heading ...", "FLASER n r1 .. rn x y heading x y heading time host time" and
// "ROBOTLASER1 type start field step most accuracy remissions n r1 .. rn m v1 .. vm x y heading x y heading
// .. time host time" (m, rad, s); skips all others. '#' starts a comment. The laser of a FLASER line scans
// 180 degrees ahead, from right to left: n beams with a spacing of 180 / n degrees, or 180 / (n - 1) if n is
// odd. A ROBOTLASER1 line says what it scans, and has the pose of the laser before that of the robot. A log
// with both has each scan twice; the form that comes first is read. A reading is invalid if it is not a
// number or not below CarmenOptions::most_m or the maximum in its line, the value that the laser gives if it
// sees nothing.
//
// Corrected logs: in the published logs, the pose in a FLASER line is that of a finished map, and the ODOM
// lines before it are in the frame of the previous FLASER line. So the motion of step k is
//     (pose of FLASER k - 1)^-1 (last ODOM before FLASER k).
// This is the raw odometry, the only one that the robot had. The poses of the FLASER lines are returned
// separately, as a reference. If there is no ODOM line between two FLASER lines, the robot stood still.
//
// Raw logs: the pose of each scan is one of the odometry, on the way from the ODOM before to the ODOM after.
// If more than half of the scans are like that, or there is no ODOM line, the odometry is the differences of
// the poses, and there is no reference.
//
// Faults: bad_input with file:line. Bounds: 2,000,000 lines, 100,000 beams in a scan. Source: CARMEN, the
// Carnegie Mellon robot navigation toolkit (Montemerlo, Roy and Thrun, IROS 2003, 2436-2441), log format.
#pragma once

#include <optional>
#include <vector>

#include "outrider/io/log/landmark_logs.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

struct LaserLogStep {
  Pose2 motion;  ///< pose relative to the previous scan, by odometry
  LaserScan scan;
};

struct LaserLog {
  std::vector<LaserLogStep> steps;
  std::vector<Pose2> reference;             ///< pose of each step in the corrected log; may be empty
  std::optional<Pose2> robot_T_laser = {};  ///< where the laser stands on the robot, if the log says it
};

struct CarmenOptions {
  double most_m = 32.0;  ///< readings of this range or more are invalid
};

std::vector<Option> describe(CarmenOptions& options);

Outcome<LaserLog> laser_log_from_carmen(const NamedText& log, const CarmenOptions& options);

/// Returns true if the text begins like one of these logs.
bool is_carmen_log(std::string_view text);

}  // namespace outrider
