// Follow waypoints in a closed loop: from where the robot believes to be to the twist to command next.
//
// Two followers:
//   pid           a PID on the pose. The command of the position and that of the heading are cut, and
//                 raised to their floors, each by its length, so a robot far off goes straight at its goal.
//   pure_pursuit  aims at a point `lookahead` further on the way; slower where the way bends and towards
//                 its end (regulated pure pursuit). The last lookahead before a stop is the PID's.
// Two manners:
//   holonomic       goes sideways as well, and turns to the heading of the waypoint on the way
//   rotate_then_go  turns towards the waypoint, goes ahead, turns to its heading; begins anew when it then
//                   stands beside it, and within a lookahead of it goes back where that turns less
//
// A turn takes the shorter way; one of nearly half a turn goes in the sense in which the headings are
// written, so that 180 after 0 is a turn to the left and 180 after 360 one to the right.
// A pure step; O(waypoints). Sources: Macenski, Singh, Martin and Gines, Regulated pure pursuit for robot
// path tracking (Autonomous Robots, 2023); Coulter, Implementation of the pure pursuit path tracking
// algorithm (1992).
#pragma once

#include <string>
#include <vector>

#include "outrider/control/pid.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

struct Waypoint {
  Pose2 pose;
  bool stop = true;  ///< come to rest there with its heading; otherwise pass by it, with any heading
  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};

struct FollowOptions {
  std::string follower = "pid";
  std::string manner = "holonomic";
  double speed_mps = 0.25;
  double turn_rate_radps = 0.8;
  double acceleration_mps2 = 0.5;
  double turn_acceleration_radps2 = 2.0;
  double least_speed_mps = 0.015;       ///< floor of a command that moves
  double least_turn_rate_radps = 0.03;  ///< floor of a command that turns
  double within_m = 0.008;              ///< of a stop, at which nothing more is commanded
  double within_rad = 0.01;
  double pass_m = 0.08;      ///< how near a waypoint is passed that is no stop
  double lookahead_m = 0.3;  ///< of pure_pursuit
};
std::vector<Option> describe(FollowOptions& options);
/// Refuses names of followers and manners that there are not.
Status check(const FollowOptions& options);

struct Follower {
  enum class Stage { aim, go, face };  ///< of rotate_then_go
  std::size_t next = 0;                ///< waypoint
  Pose2 from;                          ///< of the way to it, as it is planned
  Pid place;
  Pid heading;
  Stage stage = Stage::aim;
  Twist2 last;  ///< commanded
};

struct FollowStep {
  Twist2 twist;        ///< in the robot's frame
  bool there = false;  ///< at a stop, within the tolerances, and commanded to rest
};

/// The command for the next period. A waypoint that is no stop is passed by once the robot is near it or
/// beyond it; at a stop it stays until go_on().
FollowStep follow(Follower& follower, const std::vector<Waypoint>& waypoints, const Pose2& believed,
                  const FollowOptions& options, const PidGains& gains, double period_s);

/// Turns to the next waypoint.
void go_on(Follower& follower, const std::vector<Waypoint>& waypoints);

}  // namespace outrider
