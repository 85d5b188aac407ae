// Steer: a path follower for a disk robot with differential drive on a map that is still growing. It drives
// as fast as it can without touching a known obstacle.
//
// The robot aims at the farthest point of the path within `lookahead` that it can reach in a straight line
// with clearance `gap`, so it cuts corners where there is room. It drives while it turns, more slowly for
// larger heading errors, and turns in place beyond `pivot`. The command is then simulated for `foresight`
// under the robot's acceleration limits. If that comes closer to an obstacle than `least_gap`, and closer
// than the robot is now, the robot slows down, in the end to turning in place, which is safe for a disk.
//
// A pure function; O(cells nearby). Source: Macenski, Singh, Martin and Gines, Regulated pure pursuit for
// robot path tracking (Autonomous Robots, 2023); Fox, Burgard and Thrun, The dynamic window approach to
// collision avoidance (1997).
#pragma once

#include <vector>

#include "outrider/control/nearby.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

/// Options of steer().
struct SteerOptions {
  double lookahead_m = 0.5;          ///< largest distance to the point of the path that the robot aims at
  double gap_m = 0.02;               ///< clearance of the robot on a short cut
  double least_gap_m = 0.01;         ///< least clearance anywhere
  double pivot_rad = radians(70.0);  ///< heading error above which the robot turns in place
  double settle_s = 0.25;            ///< time in which a small heading error is corrected
  double foresight_s = 0.5;          ///< time for which a command is simulated
};
std::vector<Option> describe(SteerOptions& options);

/// A path and the progress of the robot along it.
struct PathProgress {
  std::vector<Vec2> points;  ///< at least one point
  double along_m = 0.0;      ///< arc length already driven; never decreases
};

/// Updates `along_m` to the point of the path nearest to the robot. Searches from the last such point a short
/// distance ahead.
void advance_along(PathProgress& path, Vec2 position);

/// Returns the length of the rest of the path, m.
double remaining_m(const PathProgress& path);

/// Computes the next command for a robot at `pose` that moves with `now`. The robot stops within 1 cm of the
/// path's end.
Twist2 steer(const PathProgress& path, const Pose2& pose, const Twist2& now, const Nearby& nearby,
             const RobotModel& robot, const SteerOptions& options);

}  // namespace outrider
