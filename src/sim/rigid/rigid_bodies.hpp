// The bodies of a rigid world, as skeletons of DART: the fixed yard, a robot on wheels, and balls of water.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dart/dynamics/Skeleton.hpp>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

/// Bodies collide if their masks share a bit: there is one for the robot, and one for each ball.
using CollisionMask = std::uint16_t;
constexpr CollisionMask robot_mask = 1;
constexpr CollisionMask mask_of_none = 1U << 15U;
constexpr CollisionMask mask_of_all = 0x7fff;
constexpr CollisionMask ball_mask(std::size_t ball) { return static_cast<CollisionMask>(2U << ball); }

/// Returns one fixed body with a shape node for each solid, in their order. Faults: a solid has a shape that
/// the engine does not support.
Outcome<dart::dynamics::SkeletonPtr> rigid_yard(const std::vector<Solid>& solids);

/// Returns the bodies "chassis", "left" and "right", and the joints "left_wheel" and "right_wheel", at rest.
dart::dynamics::SkeletonPtr rigid_robot(const RobotModel& robot, const Pose2& start, double floor_z_m);

/// Returns one free sphere of water, named by its number: the engine prints a message if two have one name.
dart::dynamics::SkeletonPtr rigid_ball(std::size_t number, Vec3 centre, double radius_m, Vec3 velocity_mps);

}  // namespace outrider
