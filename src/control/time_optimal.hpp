// The follower time_optimal, while it is on its timed path.
#pragma once

#include <optional>

#include "outrider/control/follow_waypoints.hpp"

namespace outrider {

/// Computes the command for the next period, and plans the timed path if there is none. Returns nothing once
/// the timed path has come to its end; the next waypoint is then its stop.
std::optional<Twist2> along_timed_path(Follower& follower, const std::vector<Waypoint>& waypoints,
                                       const Pose2& believed, const FollowOptions& options,
                                       const Chassis& chassis, double period_s);

/// Limits the change of the twist to the accelerations.
Twist2 limit_acceleration(const Twist2& wanted, const Twist2& last, const FollowOptions& options,
                          double period_s);

}  // namespace outrider
