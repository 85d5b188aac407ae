// The rigid bodies that move, as SDF text: a robot on wheels, and a ball of water.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "outrider/motion/robot_model.hpp"

namespace outrider {

/// Bodies feel each other if their masks share a bit: there is one for the robot, and one for each ball.
using FeltBy = std::uint16_t;
constexpr FeltBy felt_by_robot = 1;
constexpr FeltBy felt_by_nothing = 1U << 15U;
constexpr FeltBy felt_by_all = 0x7fff;
constexpr std::size_t most_balls = 14;
constexpr FeltBy felt_by_ball(std::size_t ball) { return static_cast<FeltBy>(2U << ball); }

/// Links "chassis", "left" and "right"; joints "left_wheel" and "right_wheel".
std::string robot_sdf(const RobotModel& robot, const Pose2& start, double floor_z_m);

/// One link. Expects a number below `most_balls`.
std::string ball_sdf(std::size_t ball, Vec3 centre, double radius_m);

}  // namespace outrider
