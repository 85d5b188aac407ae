// in_the_way(): what a robot that is a disk would touch if it went on.
#pragma once

#include <optional>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

/// When a robot has to stop.
struct StopRule {
  double radius_m = 0.1;       ///< of the robot
  double gap_m = 0.02;         ///< that it keeps
  double reaction_s = 0.3;     ///< from a scan until it obeys what follows from it
  double braking_mps2 = 0.25;  ///< half of what it can, since messages come late
  double least_m = 0.05;       ///< that it looks ahead, however slow it is
};

/// Returns the rule for a robot that can slow down so fast.
StopRule stop_rule(double radius_m, double deceleration_mps2);

/// Returns the point that is reached first by the disk of a robot with that constant twist, until it would
/// have come to rest; nothing if there is none. A point that the robot does not come nearer to, and a turn in
/// place, never count. The points are in the frame of the pose. O(points x way / 1 cm).
std::optional<Vec2> in_the_way(const std::vector<Vec2>& points, const Pose2& robot, const Twist2& twist,
                               const StopRule& rule);

}  // namespace outrider
