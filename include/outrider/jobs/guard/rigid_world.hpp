// RigidWorld: a yard in Gazebo's physics engine (ignition-physics 5 with DART), with a robot on wheels and a
// ball to throw.
//
// Bodies: each solid of the world as it is and fixed (half-spaces as planes, meshes as surfaces that hold
// from both sides), then the box of each target. A target is felt by nothing until the ball is thrown at it,
// or by all when targets block. The ball does not feel the robot, as in the ordinary simulator.
//
// The robot: an upright cylinder of 0.9 times its radius, two driven wheels whose motors keep the speed that
// they are told, and a caster without friction before and behind them. Its frame is on the floor, between
// the wheels, x ahead.
//
// The engine integrates by semi-implicit Euler steps: after a time t in steps of h a free ball is g h t / 2
// below its parabola. It sees contacts at the beginning of a step, as overlaps: a surface without thickness
// stops a ball that moves less than its diameter in a step. The same calls give the same bits.
// Thread rule: one thread at a time.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "outrider/ballistics/flight.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/sim/wheels.hpp"

namespace outrider {

class RigidWorld {
 public:
  virtual ~RigidWorld() = default;

  /// What the motors keep from now on.
  virtual void turn_wheels(const WheelSpeeds& speeds) = 0;
  virtual void step(double period_s) = 0;
  [[nodiscard]] virtual Pose3 world_T_robot() const = 0;
  /// Bodies that the robot touched at the beginning of the last step, more than 1 mm above the floor.
  [[nodiscard]] virtual std::vector<std::size_t> touched_by_robot() const = 0;

  /// A ball of water, of the gun's radius, at the muzzle of a flight with its velocity. The body of the
  /// target feels it. One at a time.
  virtual void throw_ball(const Flight& flight, std::size_t target) = 0;
  virtual void remove_ball() = 0;
  /// Its centre.
  [[nodiscard]] virtual Vec3 ball() const = 0;
  /// Bodies that the ball touched at the beginning of the last step, ascending.
  [[nodiscard]] virtual std::vector<std::size_t> touched_by_ball() const = 0;

 protected:
  RigidWorld() = default;
  RigidWorld(const RigidWorld&) = default;
  RigidWorld& operator=(const RigidWorld&) = default;
};

/// The world, targets, robot (at the start) and ball of a problem. Body i is solid i; targets follow.
/// Refused: the engine is not built in or cannot be loaded; a solid of a kind that it is not given.
Outcome<std::unique_ptr<RigidWorld>> make_rigid_world(const GuardProblem& problem);

}  // namespace outrider
