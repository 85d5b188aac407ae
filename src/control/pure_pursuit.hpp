// Regulated pure pursuit: the lookahead point on the waypoints, and the speed towards it.
#pragma once

#include "outrider/control/follow_waypoints.hpp"

namespace outrider {

struct PursuitPoint {
  Vec2 position;         ///< the lookahead point, m
  double ahead_m = 0.0;  ///< distance to the next stop along the waypoints
};

/// Finds the lookahead point on the legs from follower.from through the waypoints to the next stop. It is
/// nearer than the lookahead if the straight line to it leaves a waypoint in between farther aside than 0.7
/// of its room.
PursuitPoint find_pursuit_point(const Follower& follower, const std::vector<Waypoint>& waypoints,
                                Vec2 position, const FollowOptions& options);

/// The speed limit for an arc of that curvature (1/m) and the distance to the stop.
double regulated_speed(const PursuitPoint& pursuit, double curvature, const FollowOptions& options);

}  // namespace outrider
