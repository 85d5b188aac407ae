// Follow waypoints in a closed loop: computes the next twist from the estimated pose.
//
// Three followers:
//   pid           a PID on the pose. Position and heading commands are limited separately, by length, so a
//                 distant robot drives straight at its goal.
//   pure_pursuit  aims at a point up to `lookahead` further on the way, but cuts no corner by more than its
//                 room; slower where the way bends and towards its end (regulated pure pursuit). The last
//                 lookahead before a stop is the PID's.
//   time_optimal  plans the fastest motion to the next stop (timed_path.hpp) and holds it by feedback: the
//                 velocity of the plan, and a part of the error. If the robot is behind, the plan waits. At
//                 its end the rest is the PID's.
// Two manners:
//   holonomic       goes sideways as well, and turns to the heading of the waypoint on the way
//   rotate_then_go  turns towards the waypoint, drives ahead, turns to its heading. Starts again if it then
//                   stands beside the waypoint; within a lookahead of it, drives backwards if that turns
//                   less.
//
// A waypoint that is no stop counts once the robot is within its room or crosses the plane through it that
// halves its corner. All followers slow down before it as far as its corner and its room need.
//
// A turn takes the shorter way. A turn of about 180 degrees goes the way the written headings do: 0 to 180 is
// a left turn, 360 to 180 a right turn.
// A pure step; O(waypoints). Sources: Macenski, Singh, Martin and Gines, Regulated pure pursuit for robot
// path tracking (Autonomous Robots, 2023); Coulter, Implementation of the pure pursuit path tracking
// algorithm (1992); Kanayama, Kimura, Miyazaki and Noguchi, A stable tracking control method for an
// autonomous mobile robot (ICRA 1990); Dahl and Nielsen, Torque-limited path following by on-line trajectory
// time scaling (IEEE Transactions on Robotics and Automation, 1990).
#pragma once

#include <optional>
#include <vector>

#include "outrider/control/follow_options.hpp"
#include "outrider/control/pid.hpp"
#include "outrider/control/timed_path.hpp"

namespace outrider {

/// The state of a follower.
struct Follower {
  enum class Stage { aim, go, face };  ///< stages of rotate_then_go
  std::size_t next = 0;                ///< index of the next waypoint
  Pose2 from;                          ///< planned start of the leg to the next waypoint
  Pid place;                           ///< controller of the position
  Pid heading;                         ///< controller of the heading
  Stage stage = Stage::aim;            ///< present stage of rotate_then_go
  Twist2 last;                         ///< last commanded twist
  std::optional<TimedPath> path;       ///< of time_optimal, to the next stop
  double path_s = 0.0;                 ///< time on it
};

/// The result of a step.
struct FollowStep {
  Twist2 twist;        ///< in the robot's frame
  bool there = false;  ///< the robot is at a stop within the tolerances; the command is zero
};

/// Computes the command for the next period. Waypoints that are no stop and lie behind the robot are left
/// behind, however far it was from them; it stays at a stop until advance_to_next().
FollowStep follow(Follower& follower, const std::vector<Waypoint>& waypoints, const Pose2& believed,
                  const FollowOptions& options, const PidGains& gains, const Chassis& chassis,
                  double period_s);

/// Makes the next waypoint the goal.
void advance_to_next(Follower& follower, const std::vector<Waypoint>& waypoints);

}  // namespace outrider
