// Twists of a robot on two wheels under its limits of speed, turn rate and both accelerations; or of one that
// steers like a car, whose curve is no tighter than its turning radius: |turn| <= |ahead| / radius.
#pragma once

#include "outrider/motion/robot_model.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

/// Returns the twist after a time with a commanded one. A robot that steers takes the curve of the command,
/// whatever its speed is by then, and keeps the present curve where the command is to stand.
Twist2 twist_after(const Twist2& now, const Twist2& commanded, const RobotModel& robot, double duration_s);

/// Returns the twist with its turn as near as a robot that steers can drive it; the twist itself for others.
Twist2 drivable(const Twist2& twist, const RobotModel& robot);

/// Returns the pose after a twist that grows evenly from one to another; accurate to the third order.
Pose2 moved_evenly(const Pose2& from, const Twist2& begin, const Twist2& end, double duration_s);

}  // namespace outrider
