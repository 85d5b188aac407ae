// Follow waypoints in a closed loop: computes the next twist from the estimated pose.
//
// Two followers:
//   pid           a PID on the pose. Position and heading commands are limited separately, by length, so a
//                 distant robot drives straight at its goal.
//   pure_pursuit  aims at a point `lookahead` further on the way; slower where the way bends and towards
//                 its end (regulated pure pursuit). The last lookahead before a stop is the PID's.
// Two manners:
//   holonomic       goes sideways as well, and turns to the heading of the waypoint on the way
//   rotate_then_go  turns towards the waypoint, drives ahead, turns to its heading. Starts again if it then
//                   stands beside the waypoint; within a lookahead of it, drives backwards if that turns
//                   less.
//
// A turn takes the shorter way. A turn of about 180 degrees goes the way the written headings do: 0 to 180 is
// a left turn, 360 to 180 a right turn.
// A pure step; O(waypoints). Sources: Macenski, Singh, Martin and Gines, Regulated pure pursuit for robot
// path tracking (Autonomous Robots, 2023); Coulter, Implementation of the pure pursuit path tracking
// algorithm (1992).
#pragma once

#include <string>
#include <vector>

#include "outrider/control/pid.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

/// A waypoint of a path.
struct Waypoint {
  Pose2 pose;
  bool stop = true;  ///< come to rest there with its heading; otherwise pass by it, with any heading
  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};

/// Options of a follower.
struct FollowOptions {
  std::string follower = "pid";           ///< pid or pure_pursuit
  std::string mode = "holonomic";         ///< holonomic or rotate_then_go
  double speed_mps = 0.25;                ///< maximum speed
  double turn_rate_radps = 0.8;           ///< maximum turn rate
  double acceleration_mps2 = 0.5;         ///< maximum acceleration
  double turn_acceleration_radps2 = 2.0;  ///< maximum angular acceleration
  double least_speed_mps = 0.015;         ///< least speed of a command that is not zero
  double least_turn_rate_radps = 0.03;    ///< least turn rate of a command that is not zero
  double within_m = 0.008;                ///< position tolerance at a stop
  double within_rad = 0.01;               ///< heading tolerance at a stop
  double pass_m = 0.08;      ///< distance within which a waypoint that is no stop counts as passed
  double lookahead_m = 0.3;  ///< lookahead distance of pure_pursuit
};
std::vector<Option> describe(FollowOptions& options);
/// Refuses unknown names of followers and manners.
Status check(const FollowOptions& options);

/// The state of a follower.
struct Follower {
  enum class Stage { aim, go, face };  ///< stages of rotate_then_go
  std::size_t next = 0;                ///< index of the next waypoint
  Pose2 from;                          ///< planned start of the leg to the next waypoint
  Pid place;                           ///< controller of the position
  Pid heading;                         ///< controller of the heading
  Stage stage = Stage::aim;            ///< present stage of rotate_then_go
  Twist2 last;                         ///< last commanded twist
};

/// The result of a step.
struct FollowStep {
  Twist2 twist;        ///< in the robot's frame
  bool there = false;  ///< the robot is at a stop within the tolerances; the command is zero
};

/// Computes the command for the next period. The robot passes a waypoint that is no stop once it is near or
/// beyond it; it stays at a stop until advance_to_next().
FollowStep follow(Follower& follower, const std::vector<Waypoint>& waypoints, const Pose2& believed,
                  const FollowOptions& options, const PidGains& gains, double period_s);

/// Makes the next waypoint the goal.
void advance_to_next(Follower& follower, const std::vector<Waypoint>& waypoints);

}  // namespace outrider
