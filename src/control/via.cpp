#include "via.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double half_turn_rad = 2.6;  ///< larger turns go the way the headings are written

}  // namespace

double room_at(const Waypoint& via, const FollowOptions& options) {
  return std::min(via.room_m, options.pass_m);
}

double corner_rad(Vec2 from, const std::vector<Waypoint>& waypoints, std::size_t waypoint) {
  const Vec2 at = waypoints[waypoint].pose.position;
  const Vec2 before = at - from;
  for (std::size_t i = waypoint + 1; i < waypoints.size(); ++i) {
    const Vec2 after = waypoints[i].pose.position - at;
    if (squared_norm(after) == 0.0) continue;
    return squared_norm(before) > 0.0 ? wrap_angle(heading_of(after) - heading_of(before)) : 0.0;
  }
  return 0.0;
}

bool is_passed(const Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position,
               const FollowOptions& options) {
  const Waypoint& via = waypoints[follower.next];
  const Vec2 beyond = position - via.pose.position;
  if (norm(beyond) <= room_at(via, options)) return true;
  const Vec2 leg = via.pose.position - follower.from.position;
  const double half_corner =
      std::clamp(0.5 * corner_rad(follower.from.position, waypoints, follower.next), -0.25 * pi, 0.25 * pi);
  return dot(beyond, rotated(half_corner, leg)) > 0.0;
}

/// A velocity of the size v that turns by the corner at the acceleration a follows a parabola that comes to
/// v^2 sin^2(corner / 2) / (2 a) of the via. A robot that turns in place there stops within v^2 / (2 a).
double speed_towards_vias(const Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position,
                          const FollowOptions& options) {
  const double braking_mps2 = 0.5 * options.acceleration_mps2;  // a body that turns needs the other half
  const double fastest = options.speed_mps * options.speed_mps;
  double square = fastest, way_m = 0.0;
  Vec2 from = follower.from.position, at = position;
  for (std::size_t i = follower.next; !waypoints[i].stop && 2.0 * braking_mps2 * way_m < fastest; ++i) {
    const Vec2 via = waypoints[i].pose.position;
    const double corner = std::abs(corner_rad(from, waypoints, i));
    const bool stops = options.mode == "rotate_then_go" && corner > aimed_rad;
    const double share = stops ? 1.0 : std::sin(0.5 * corner);
    const double room_m = room_at(waypoints[i], options);
    way_m += distance(at, via);
    const double there = 2.0 * braking_mps2 * room_m / std::max(share * share, 1e-9);
    square = std::min(square, there + 2.0 * braking_mps2 * std::max(0.0, way_m - room_m));
    from = at = via;
  }
  return std::max(options.least_speed_mps, std::sqrt(square));
}

void pass_by(Follower& follower, const std::vector<Waypoint>& waypoints) {
  auto path = std::move(follower.path);
  const double path_s = follower.path_s;
  advance_to_next(follower, waypoints);
  follower.path = std::move(path);
  follower.path_s = path_s;
}

double remaining_turn_rad(double from_rad, const Waypoint& goal, double heading_rad) {
  const double error = wrap_angle(goal.pose.heading_rad - heading_rad);
  const double written = goal.pose.heading_rad - from_rad;
  if (std::abs(error) < half_turn_rad || written * error >= 0.0) return error;
  return error + std::copysign(2.0 * pi, written);
}

}  // namespace outrider
