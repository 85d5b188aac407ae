// Regulated pure pursuit: the point to aim at on a way, and how fast to go there.
#pragma once

#include "outrider/control/follow_waypoints.hpp"

namespace outrider {

struct Pursued {
  Vec2 carrot;           ///< the point to aim at, m
  double ahead_m = 0.0;  ///< to the next stop, along the way
};

/// On the way from follower.from through the waypoints to the next stop.
Pursued carrot_on(const Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position,
                  double lookahead_m);

/// The speed that is slower towards the stop and where an arc of that curvature (1/m) is tight.
double regulated_speed(const Pursued& pursued, double curvature, const FollowOptions& options);

}  // namespace outrider
