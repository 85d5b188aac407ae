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

double corner_rad(const Follower& follower, const std::vector<Waypoint>& waypoints) {
  const Vec2 at = waypoints[follower.next].pose.position;
  const Vec2 before = at - follower.from.position;
  for (std::size_t i = follower.next + 1; i < waypoints.size(); ++i) {
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
  const double half_corner = std::clamp(0.5 * corner_rad(follower, waypoints), -0.25 * pi, 0.25 * pi);
  return dot(beyond, rotated(half_corner, leg)) > 0.0;
}

/// A velocity of the size v that turns by the corner at the acceleration a follows a parabola that comes to
/// v^2 sin^2(corner / 2) / (2 a) of the via. A robot that turns in place there stops within v^2 / (2 a).
double speed_towards_via(const Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position,
                         const FollowOptions& options) {
  const Waypoint& via = waypoints[follower.next];
  if (via.stop) return options.speed_mps;
  const double corner = std::abs(corner_rad(follower, waypoints));
  const bool stops = options.mode == "rotate_then_go" && corner > aimed_rad;
  const double share = stops ? 1.0 : std::sin(0.5 * corner);
  const double room_m = room_at(via, options);
  const double braking_mps2 = 0.5 * options.acceleration_mps2;  // a body that turns needs the other half
  const double there_mps2 = 2.0 * braking_mps2 * room_m / std::max(share * share, 1e-9);
  const double left_m = std::max(0.0, distance(position, via.pose.position) - room_m);
  return std::clamp(std::sqrt(there_mps2 + 2.0 * braking_mps2 * left_m), options.least_speed_mps,
                    options.speed_mps);
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
