// FollowOptions: waypoints, and how a robot follows them.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/chassis.hpp"

namespace outrider {

/// A waypoint of a path.
struct Waypoint {
  Pose2 pose;
  bool stop = true;  ///< come to rest there with its heading; otherwise pass by it, with any heading
  /// Largest distance from the waypoint, m, at which its corner may be cut if it is no stop;
  /// `FollowOptions::pass_m` limits it too.
  double room_m = std::numeric_limits<double>::infinity();
  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};

/// Options of a follower.
struct FollowOptions {
  std::string follower = "pid";           ///< pid, pure_pursuit or time_optimal
  std::string mode = "holonomic";         ///< holonomic or rotate_then_go
  double speed_mps = 0.25;                ///< maximum speed
  double turn_rate_radps = 0.8;           ///< maximum turn rate
  double acceleration_mps2 = 0.5;         ///< maximum acceleration
  double turn_acceleration_radps2 = 2.0;  ///< maximum angular acceleration
  double least_speed_mps = 0.015;         ///< least speed of a command that is not zero
  double least_turn_rate_radps = 0.03;    ///< least turn rate of a command that is not zero
  double within_m = 0.008;                ///< position tolerance at a stop
  double within_rad = 0.01;               ///< heading tolerance at a stop
  double pass_m = 0.08;             ///< distance within which a waypoint that is no stop is to be passed
  double wheel_speed_radps = 20.0;  ///< maximum speed of a wheel; used by time_optimal
  double lookahead_m = 0.3;         ///< lookahead distance of pure_pursuit
};
std::vector<Option> describe(FollowOptions& options);
/// Refuses unknown names of followers and manners.
Status check(const FollowOptions& options);

}  // namespace outrider
