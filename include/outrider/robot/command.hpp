// Command: what a mission asks of a robot. The set is closed: a robot carries out those for which it has the
// devices, and ignores the rest.
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

/// A shot from a robot that drives: turn the barrel there while driving, from the beginning of the straight
/// or from the shot before on it, and shoot at that moment.
struct FireInPassing {
  std::size_t target = 0;
  std::size_t leg = 0;   ///< the straight to this waypoint
  double after_s = 0.0;  ///< since the straight began
  Shot shot;             ///< of the barrel; the ball has the velocity of the robot as well
};

/// Turn towards each waypoint in place, drive straight to it, come to rest at the last.
struct FollowWaypoints {
  std::vector<Vec2> waypoints;            ///< the first is where the robot stands
  bool until_arrival = false;             ///< end at the next waypoint once somebody has entered
  std::vector<FireInPassing> shots = {};  ///< in order; the command ends when their balls have landed
};
/// Turn in place to where the piece begins, stand for the pause, drive along it from rest to rest.
struct FollowPiece {
  PathPiece piece;
  std::optional<PathPiece> next = {};  ///< the piece after it, if there is one
  double pause_s = 0.0;
};
/// Keep a twist until then, when the robot senses again.
struct DriveTwist {
  Twist2 twist;
  double until_s = 0.0;
};
/// Keep wheel speeds until then, when the robot senses again.
struct DriveWheels {
  WheelSpeeds4 wheels{};
  double until_s = 0.0;
};
/// Stand still until that time, or until somebody enters.
struct Wait {
  double until_s = 0.0;  ///< may be infinite
};
/// Bring the barrel to a yaw in the world and a pitch.
struct AimGun {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};
/// Shoot along the barrel.
struct Fire {
  std::size_t target = 0;
  Shot shot;
};
/// Fill a store to the brim at the station where the robot stands.
struct Fill {
  StationCall call;
};
/// Let a second pass in which one robot of a team goes to a neighbouring cell, or stays.
struct StepToCell {
  std::size_t robot = 0;
  Cell cell;
};

using Command =
    std::variant<FollowWaypoints, FollowPiece, DriveTwist, DriveWheels, Wait, AimGun, Fire, Fill, StepToCell>;

}  // namespace outrider
