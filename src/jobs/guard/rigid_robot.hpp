// The rigid bodies that move, as SDF text: a robot on wheels, and a ball of water.
#pragma once

#include <string>

#include "outrider/motion/robot_model.hpp"

namespace outrider {

/// Which bodies feel each other: those that share a bit.
enum FeltBy : unsigned { robot_only = 1, ball_only = 2, robot_and_ball = 3, nothing = 4 };

/// Links "chassis", "left" and "right"; joints "left_wheel" and "right_wheel".
std::string robot_sdf(const RobotModel& robot, const Pose2& start, double floor_z_m);

/// One link.
std::string ball_sdf(Vec3 centre, double radius_m);

}  // namespace outrider
