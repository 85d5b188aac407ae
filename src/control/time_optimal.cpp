#include "time_optimal.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "via.hpp"

namespace outrider {
namespace {

constexpr double along_gain = 3.0;  ///< 1/s: velocity per error of the position
constexpr double across_gain =
    15.0;  ///< 1/m^2: bend per error across, for a robot that points along the path
constexpr double heading_gain = 3.0;  ///< 1/s: turn rate per error of the heading
constexpr double in_time_m = 0.03;    ///< with a smaller error the plan goes on at its pace
constexpr double waits_m = 0.08;      ///< with a larger one it waits
constexpr double lever_m = 0.15;      ///< an error of the heading counts as much as one of the position at it
constexpr double braking = 0.8;       ///< part of the turn acceleration with which a turn ends

/// Returns the part of its pace at which the plan goes on: trajectory time scaling.
double pace(double error_m) { return std::clamp((waits_m - error_m) / (waits_m - in_time_m), 0.0, 1.0); }

/// Shortens the translation to the fastest speed, and the twist until no wheel is too fast.
Twist2 limit_speed(Twist2 twist, const FollowOptions& options, const Chassis& chassis) {
  const double speed = speed_of(twist);
  if (speed > options.speed_mps) {
    twist.ahead_mps *= options.speed_mps / speed;
    twist.left_mps *= options.speed_mps / speed;
  }
  twist.turn_radps = std::clamp(twist.turn_radps, -options.turn_rate_radps, options.turn_rate_radps);
  double fastest = 0.0;
  for (const double wheel : wheel_speeds(chassis, twist)) fastest = std::max(fastest, std::abs(wheel));
  return fastest > options.wheel_speed_radps ? (options.wheel_speed_radps / fastest) * twist : twist;
}

/// Turns to a heading in the least time.
double fastest_turn(double error_rad, const FollowOptions& options) {
  const double off = std::abs(error_rad);
  const double stopping = std::sqrt(2.0 * braking * options.turn_acceleration_radps2 * off);
  return std::copysign(std::min({options.turn_rate_radps, stopping, heading_gain * off}), error_rad);
}

/// Holds the timed path with velocities in any direction.
Twist2 hold_any_way(Follower& follower, const Waypoint& next, const Pose2& believed,
                    const FollowOptions& options, double period_s) {
  const TimedPath& motion = *follower.path;
  const Pose2 planned = pose_at(motion, follower.path_s);
  const Vec2 error = planned.position - believed.position;
  follower.path_s += pace(norm(error)) * period_s;
  const Vec2 then = pose_at(motion, follower.path_s).position;
  const Vec2 velocity = (1.0 / period_s) * (then - planned.position) + along_gain * error;
  const double turn =
      fastest_turn(remaining_turn_rad(follower.from.heading_rad, next, believed.heading_rad), options);
  const Vec2 body = unrotated(believed.heading_rad + 0.5 * turn * period_s, velocity);
  return {body.x, body.y, turn};
}

/// Holds the timed path with velocities ahead.
Twist2 hold_ahead(Follower& follower, const Pose2& believed, double period_s) {
  const TimedPath& motion = *follower.path;
  const Pose2 planned = pose_at(motion, follower.path_s);
  const Vec2 error = believed.to_local(planned.position);
  const double turn_error = wrap_angle(planned.heading_rad - believed.heading_rad);
  follower.path_s += pace(norm(error) + lever_m * std::abs(turn_error)) * period_s;
  const Pose2 then = pose_at(motion, follower.path_s);
  const double speed = distance(planned.position, then.position) / period_s;
  const double turn = (then.heading_rad - planned.heading_rad) / period_s;
  const double along = speed > 0.0 ? along_gain * error.x : 0.0;
  return {speed * std::cos(turn_error) + along, 0.0,
          turn + across_gain * speed * error.y + heading_gain * turn_error};
}

}  // namespace

std::optional<Twist2> along_timed_path(Follower& follower, const std::vector<Waypoint>& waypoints,
                                       const Pose2& believed, const FollowOptions& options,
                                       const Chassis& chassis, double period_s) {
  if (!follower.path) {
    follower.path = timed_path_to_stop(believed, waypoints, follower.next, options, chassis);
    follower.path_s = 0.0;
  }
  if (follower.path_s >= follower.path->duration_s) {
    while (!waypoints[follower.next].stop) pass_by(follower, waypoints);
    return std::nullopt;
  }
  const Twist2 wanted = options.mode == "holonomic"
                            ? hold_any_way(follower, waypoints[follower.next], believed, options, period_s)
                            : hold_ahead(follower, believed, period_s);
  // The velocity does not turn with the robot, but the frame in which the last twist was given does.
  const Vec2 last =
      unrotated(follower.last.turn_radps * period_s, {follower.last.ahead_mps, follower.last.left_mps});
  return limit_acceleration(limit_speed(wanted, options, chassis), {last.x, last.y, follower.last.turn_radps},
                            options, period_s);
}

Twist2 limit_acceleration(const Twist2& wanted, const Twist2& last, const FollowOptions& options,
                          double period_s) {
  Vec2 change = {wanted.ahead_mps - last.ahead_mps, wanted.left_mps - last.left_mps};
  const double most = options.acceleration_mps2 * period_s;
  if (norm(change) > most) change = (most / norm(change)) * change;
  const double most_turn = options.turn_acceleration_radps2 * period_s;
  const double turn = std::clamp(wanted.turn_radps - last.turn_radps, -most_turn, most_turn);
  return last + Twist2{change.x, change.y, turn};
}

}  // namespace outrider
