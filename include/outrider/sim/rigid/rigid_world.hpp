// RigidWorld: a world in the physics engine DART, with a wheeled robot and balls.
//
// Bodies: each solid of the world is a fixed body (half-spaces are planes, meshes are two-sided surfaces),
// followed by the box of each target. A target collides only with balls that are thrown at it; if targets
// block, it collides with everything. Balls collide neither with the robot nor with each other, as in the
// kinematic simulator.
//
// The robot is an upright cylinder of 0.9 times its radius with two driven wheels, whose motors keep the
// commanded speed, and a frictionless caster in front of and behind them. Its frame is on the floor between
// the wheels, with x ahead.
//
// The engine uses semi-implicit Euler steps: after a time t with step h, a free ball is g h t / 2 below its
// exact parabola. Contacts are detected at the beginning of a step, as overlaps, so a surface without
// thickness stops a ball only if it moves less than its diameter per step. The same calls give the same bits.
// Thread rule: one thread at a time.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "outrider/ballistics/flight.hpp"
#include "outrider/ballistics/target.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/sim/bodies/wheels.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

inline constexpr std::size_t most_balls = 14;  ///< in the air at a time

/// The bodies of a rigid world.
struct RigidScene {
  World world;                  ///< its solids, its floor and its gravity
  std::vector<Target> targets;  ///< boxes
  bool targets_block = false;   ///< targets collide with everything, not only with the balls thrown at them
  RobotModel robot;
  Pose2 start;
  double ball_radius_m = 0.01;
};

class RigidWorld {
 public:
  virtual ~RigidWorld() = default;

  /// Sets the speed that the motors keep from now on.
  virtual void turn_wheels(const WheelSpeeds& speeds) = 0;
  /// Advances the simulation by one step.
  virtual void step(double period_s) = 0;
  [[nodiscard]] virtual Pose3 world_T_robot() const = 0;
  /// Returns the velocity of a point of the world that is fixed to the robot, m/s.
  [[nodiscard]] virtual Vec3 velocity_at(Vec3 point) const = 0;
  /// Returns the bodies that the robot touched, more than 1 mm above the floor, at the beginning of the last
  /// step.
  [[nodiscard]] virtual std::vector<std::size_t> touched_by_robot() const = 0;

  /// Adds a ball at the muzzle of a flight, with its initial velocity and the ball radius of the scene. The
  /// body of the target collides with it. Returns the number of the ball, the smallest that is free; nothing
  /// if 14 balls are in the air.
  virtual std::optional<std::size_t> throw_ball(const Flight& flight, std::size_t target) = 0;
  virtual void remove_ball(std::size_t ball) = 0;
  /// Returns the centre of a ball.
  [[nodiscard]] virtual Vec3 ball(std::size_t ball) const = 0;
  /// Returns the bodies that a ball touched at the beginning of the last step, in ascending order.
  [[nodiscard]] virtual std::vector<std::size_t> touched_by_ball(std::size_t ball) const = 0;

 protected:
  RigidWorld() = default;
  RigidWorld(const RigidWorld&) = default;
  RigidWorld& operator=(const RigidWorld&) = default;
};

/// Makes the rigid world of a scene with the robot at the start. Body i is solid i; the targets follow.
/// Faults: Outrider was built without the engine, or the engine cannot be loaded; the engine does not support
/// the shape of a solid.
Outcome<std::unique_ptr<RigidWorld>> make_rigid_world(const RigidScene& scene);

}  // namespace outrider
