#include "pure_pursuit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "outrider/geometry/convex.hpp"
#include "via.hpp"

namespace outrider {
namespace {

/// Returns the point of the next leg that is nearest to a position.
Vec2 progress_point(const Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position) {
  const Vec2 goal = waypoints[follower.next].pose.position;
  const Vec2 leg = goal - follower.from.position;
  const double square = squared_norm(leg);
  if (square == 0.0) return goal;
  return follower.from.position +
         std::clamp(dot(position - follower.from.position, leg) / square, 0.0, 1.0) * leg;
}

/// Returns the point of the way `ahead_m` beyond `at`, which lies on the next leg; the way ends at a stop. If
/// the straight line from `position` to it cuts a corner by more than its room, returns nothing.
std::optional<Vec2> aim_point(const Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position,
                              Vec2 at, double ahead_m, const FollowOptions& options) {
  std::size_t i = follower.next;
  for (;; ++i) {
    const Vec2 end = waypoints[i].pose.position;
    const double way = distance(at, end);
    const bool last = waypoints[i].stop || i + 1 == waypoints.size();
    if (way >= ahead_m || last) {
      at = way > ahead_m ? at + (ahead_m / way) * (end - at) : end;
      break;
    }
    ahead_m -= way;
    at = end;
  }
  for (std::size_t k = follower.next; k < i; ++k) {
    if (distance(waypoints[k].pose.position, Segment{position, at}) >
        used_room * room_at(waypoints[k], options))
      return std::nullopt;
  }
  return at;
}

}  // namespace

PursuitPoint find_pursuit_point(const Follower& follower, const std::vector<Waypoint>& waypoints,
                                Vec2 position, const FollowOptions& options) {
  constexpr int tries = 16;
  const Vec2 start = progress_point(follower, waypoints, position);
  PursuitPoint pursuit{waypoints[follower.next].pose.position, 0.0};
  for (int k = tries; k > 0; --k) {
    const double ahead_m = options.lookahead_m * k / tries;
    const auto aim = aim_point(follower, waypoints, position, start, ahead_m, options);
    if (!aim) continue;
    pursuit.position = *aim;
    break;
  }
  Vec2 at = start;
  for (std::size_t i = follower.next; i < waypoints.size(); ++i) {
    pursuit.ahead_m += distance(at, waypoints[i].pose.position);
    at = waypoints[i].pose.position;
    if (waypoints[i].stop) break;
  }
  return pursuit;
}

double regulated_speed(const PursuitPoint& pursuit, double curvature, const FollowOptions& options) {
  const double bend = options.turn_rate_radps / std::max(std::abs(curvature), 1e-9);
  const double approach = std::sqrt(options.acceleration_mps2 * pursuit.ahead_m);  // half of the limit
  return std::max(options.least_speed_mps, std::min({options.speed_mps, bend, approach}));
}

}  // namespace outrider
