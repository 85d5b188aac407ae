// Command: what a mission tells a robot to do next. The set of commands is closed. A robot carries out the
// commands for which it has the devices and ignores the others.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "outrider/ballistics/flight.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/chassis.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/robot/supplies.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Turn the barrel to a yaw in the world frame and a pitch.
struct AimGun {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};

/// A shot fired while the robot drives along a straight leg. The barrel starts to turn when the drive begins,
/// or after the previous shot; the gun fires `after_s` after the leg began.
struct FireInPassing {
  std::size_t target = 0;  ///< index of the target
  std::size_t leg = 0;     ///< index of the waypoint at which the leg ends
  double after_s = 0.0;    ///< time of the shot, counted from the beginning of the leg, s
  Shot shot;               ///< barrel direction and muzzle speed; the velocity of the robot is added
};

/// Drive along waypoints: turn in place towards the next one, drive straight to it and stop, until the last.
struct FollowWaypoints {
  std::vector<Vec2> waypoints;            ///< the first is the present position of the robot
  bool until_arrival = false;             ///< stop at the next waypoint once an intruder enters
  std::vector<FireInPassing> shots = {};  ///< in order of time
  /// Direction of the barrel on arrival; it turns there during the drive, after the last shot.
  std::optional<AimGun> aim = {};
};
/// Drive along one piece of a path: turn in place to its initial heading, wait for the pause, then drive
/// along the piece from rest to rest.
struct FollowPiece {
  PathPiece piece;
  std::optional<PathPiece> next = {};  ///< the following piece, if there is one
  double pause_s = 0.0;                ///< waiting time before the drive, s
};
/// Drive with a constant twist until `until_s`; then the robot senses again.
struct DriveTwist {
  Twist2 twist;
  double until_s = 0.0;
};
/// Drive with constant wheel speeds until `until_s`; then the robot senses again.
struct DriveWheels {
  WheelSpeeds4 wheels{};
  double until_s = 0.0;
};
/// Stand still until `until_s`, or until an intruder enters.
struct Wait {
  double until_s = 0.0;  ///< may be infinite
};
/// Fire along the present direction of the barrel.
struct Fire {
  std::size_t target = 0;  ///< index of the target
  Shot shot;
  bool until_landed = true;  ///< the command ends when the ball has landed; otherwise at once
};
/// Fill a store completely at the station where the robot stands.
struct Fill {
  StationCall call;
};
/// Move one robot of a team to a neighbouring cell, or let it stay. The step takes one second.
struct StepToCell {
  std::size_t robot = 0;
  Cell cell;
  Cell then = cell;  ///< where it goes in the second after, so that robots on wheels need not stop
};

using Command =
    std::variant<FollowWaypoints, FollowPiece, DriveTwist, DriveWheels, Wait, AimGun, Fire, Fill, StepToCell>;

}  // namespace outrider
