#include "pure_pursuit.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {

PursuitPoint find_pursuit_point(const Follower& follower, const std::vector<Waypoint>& waypoints,
                                Vec2 position, double lookahead_m) {
  const Vec2 goal = waypoints[follower.next].pose.position;
  const Vec2 leg = goal - follower.from.position;
  const double length = norm(leg);
  double done = 0.0;
  if (length > 0.0) done = std::clamp(dot(position - follower.from.position, leg) / length, 0.0, length);
  double left = lookahead_m;
  Vec2 at = length > 0.0 ? follower.from.position + (done / length) * leg : goal;
  PursuitPoint pursuit{goal, 0.0};
  bool found = false;
  for (std::size_t i = follower.next;; ++i) {
    const Vec2 end = waypoints[i].pose.position;
    const double way = distance(at, end);
    if (!found && way >= left) {
      pursuit.position = way > 0.0 ? at + (left / way) * (end - at) : end;
      found = true;
    }
    left -= way;
    pursuit.ahead_m += way;
    at = end;
    if (waypoints[i].stop || i + 1 == waypoints.size()) break;
  }
  if (!found) pursuit.position = at;
  return pursuit;
}

double regulated_speed(const PursuitPoint& pursuit, double curvature, const FollowOptions& options) {
  const double bend = options.turn_rate_radps / std::max(std::abs(curvature), 1e-9);
  const double approach = std::sqrt(options.acceleration_mps2 * pursuit.ahead_m);  // half of the limit
  return std::max(options.least_speed_mps, std::min({options.speed_mps, bend, approach}));
}

}  // namespace outrider
