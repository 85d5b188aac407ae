// Twists of a robot on two wheels under its limits of speed, turn rate and both accelerations.
#pragma once

#include "outrider/motion/robot_model.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

/// Returns the twist after a time with a commanded one.
Twist2 twist_after(const Twist2& now, const Twist2& commanded, const RobotModel& robot, double duration_s);

/// Returns the pose after a twist that grows evenly from one to another; accurate to the third order.
Pose2 moved_evenly(const Pose2& from, const Twist2& begin, const Twist2& end, double duration_s);

}  // namespace outrider
