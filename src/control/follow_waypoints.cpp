#include "outrider/control/follow_waypoints.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "pure_pursuit.hpp"
#include "time_optimal.hpp"
#include "via.hpp"

namespace outrider {
namespace {

constexpr double off_course_rad = 0.7;  ///< bearing error above which it stops to turn

const Waypoint& goal_of(const Follower& follower, const std::vector<Waypoint>& waypoints) {
  return waypoints[follower.next];
}

/// Returns the remaining turn to a waypoint's heading, rad.
double heading_error(const Follower& follower, const Waypoint& goal, double heading_rad) {
  return remaining_turn_rad(follower.from.heading_rad, goal, heading_rad);
}

double turn_command(Follower& follower, double error, const FollowOptions& options, const PidGains& gains,
                    double period_s) {
  return step(follower.heading, gains, {error, 0.0}, {options.turn_rate_radps, options.least_turn_rate_radps},
              period_s)
      .x;
}

/// Returns the velocity towards the next waypoint, `error` away. A via is passed at the speed of its corner.
Vec2 place_command(Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position,
                   const FollowOptions& options, const PidGains& gains, double period_s) {
  const Waypoint& goal = goal_of(follower, waypoints);
  const double most = speed_towards_vias(follower, waypoints, position, options);
  const PidRange range{most, goal.stop ? options.least_speed_mps : most};
  return step(follower.place, gains, goal.pose.position - position, range, period_s);
}

/// Converts a velocity in the world to a twist of the robot.
Twist2 in_body(Vec2 velocity_mps, double turn_radps, double heading_rad) {
  const Vec2 ahead = direction(heading_rad);
  return {dot(velocity_mps, ahead), cross(ahead, velocity_mps), turn_radps};
}

FollowStep holonomic(Follower& follower, const std::vector<Waypoint>& waypoints, const Pose2& believed,
                     const FollowOptions& options, const PidGains& gains, double period_s) {
  const Waypoint& goal = goal_of(follower, waypoints);
  const Vec2 error = goal.pose.position - believed.position;
  const double turn_error = heading_error(follower, goal, believed.heading_rad);
  const bool at_place = goal.stop && norm(error) <= options.within_m;
  const bool facing = std::abs(turn_error) <= options.within_rad;
  const double turn = facing ? 0.0 : turn_command(follower, turn_error, options, gains, period_s);
  Vec2 velocity;
  if (!at_place) {
    velocity = place_command(follower, waypoints, believed.position, options, gains, period_s);
    if (options.follower == "pure_pursuit") {
      const PursuitPoint pursuit = find_pursuit_point(follower, waypoints, believed.position, options);
      const Vec2 aim = pursuit.position - believed.position;
      if (pursuit.ahead_m > options.lookahead_m && norm(aim) > 0.0) {
        velocity = (std::min(speed_towards_vias(follower, waypoints, believed.position, options),
                             regulated_speed(pursuit, 0.0, options)) /
                    norm(aim)) *
                   aim;
      }
    }
  }
  return {in_body(velocity, turn, believed.heading_rad), at_place && facing};
}

/// Drives ahead on the arc of pure pursuit.
Twist2 along_arc(const Follower& follower, const std::vector<Waypoint>& waypoints, const Pose2& believed,
                 const FollowOptions& options) {
  const PursuitPoint pursuit = find_pursuit_point(follower, waypoints, believed.position, options);
  const Vec2 aim = believed.to_local(pursuit.position);
  const double curvature = 2.0 * aim.y / std::max(squared_norm(aim), 1e-9);
  const double speed = std::min(speed_towards_vias(follower, waypoints, believed.position, options),
                                regulated_speed(pursuit, curvature, options));
  return {speed, 0.0, speed * curvature};
}

Twist2 going(Follower& follower, const std::vector<Waypoint>& waypoints, const Pose2& believed,
             double bearing, const FollowOptions& options, const PidGains& gains, double period_s) {
  const Waypoint& goal = goal_of(follower, waypoints);
  const Vec2 error = goal.pose.position - believed.position;
  const bool far = norm(error) > options.lookahead_m || !goal.stop;
  if (options.follower == "pure_pursuit" && far) return along_arc(follower, waypoints, believed, options);
  const double ahead = norm(place_command(follower, waypoints, believed.position, options, gains, period_s));
  return {ahead * std::cos(bearing), 0.0, turn_command(follower, bearing, options, gains, period_s)};
}

FollowStep rotate_then_go(Follower& follower, const std::vector<Waypoint>& waypoints, const Pose2& believed,
                          const FollowOptions& options, const PidGains& gains, double period_s) {
  using Stage = Follower::Stage;
  const Waypoint& goal = goal_of(follower, waypoints);
  const Vec2 error = goal.pose.position - believed.position;
  const double off = norm(error);
  double bearing = off > 0.0 ? wrap_angle(heading_of(error) - believed.heading_rad) : 0.0;
  const bool backwards = goal.stop && off < options.lookahead_m && std::abs(bearing) > 0.5 * pi;
  if (backwards) bearing = wrap_angle(bearing + pi);
  const double turn_error = heading_error(follower, goal, believed.heading_rad);
  const bool facing = std::abs(turn_error) <= options.within_rad;
  Stage& stage = follower.stage;
  if (stage == Stage::face && facing && off > 2.0 * options.within_m) stage = Stage::aim;
  if (stage == Stage::go && std::abs(bearing) > off_course_rad) {
    stage =
        off < 4.0 * options.within_m ? Stage::face : Stage::aim;  // it has passed the goal, or lost its way
  }
  if (stage == Stage::aim && std::abs(bearing) <= aimed_rad) stage = Stage::go;
  if (stage != Stage::face && goal.stop && off <= options.within_m) stage = Stage::face;
  if (stage == Stage::go) {
    Twist2 twist = going(follower, waypoints, believed, bearing, options, gains, period_s);
    if (backwards) twist.ahead_mps = -twist.ahead_mps;
    return {twist, false};
  }
  if (stage == Stage::face && facing) return {{}, true};
  const double turn = stage == Stage::aim ? bearing : turn_error;
  return {{0.0, 0.0, turn_command(follower, turn, options, gains, period_s)}, false};
}

}  // namespace

std::vector<Option> describe(FollowOptions& options) {
  return {
      {"follower", "", 0, 0, "pid, pure_pursuit or time_optimal", &options.follower},
      {"mode", "", 0, 0, "holonomic or rotate_then_go", &options.mode},
      {"speed", "m/s", 0.01, 10.0, "fastest drive", &options.speed_mps},
      {"turn_rate", "rad/s", 0.01, 10.0, "fastest turn", &options.turn_rate_radps},
      {"acceleration", "m/s2", 0.01, 100.0, "fastest change of the speed", &options.acceleration_mps2},
      {"turn_acceleration", "rad/s2", 0.01, 100.0, "fastest change of the turn rate",
       &options.turn_acceleration_radps2},
      {"least_speed", "m/s", 0.0, 1.0, "slowest drive that is commanded", &options.least_speed_mps},
      {"least_turn_rate", "rad/s", 0.0, 1.0, "slowest turn that is commanded",
       &options.least_turn_rate_radps},
      {"within", "m", 1e-4, 1.0, "near enough to a stop", &options.within_m},
      {"within_angle", "deg", 0.01, 90.0, "near enough to its heading", &options.within_rad},
      {"pass", "m", 1e-3, 10.0, "near enough to a waypoint that is no stop", &options.pass_m},
      {"wheel_speed", "rad/s", 0.1, 1000.0, "fastest turn of a wheel, for time_optimal",
       &options.wheel_speed_radps},
      {"lookahead", "m", 0.01, 10.0, "how far on the way pure_pursuit aims", &options.lookahead_m},
  };
}

Status check(const FollowOptions& options) {
  const auto check_name = [](const char* key, const std::string& value,
                             const std::vector<std::string>& known) -> Status {
    if (std::ranges::find(known, value) != known.end()) return {};
    return no_such_row(key, value, known, std::string("follow.") + key);
  };
  if (auto ok = check_name("follower", options.follower, {"pid", "pure_pursuit", "time_optimal"}); !ok)
    return ok;
  return check_name("mode", options.mode, {"holonomic", "rotate_then_go"});
}

FollowStep follow(Follower& follower, const std::vector<Waypoint>& waypoints, const Pose2& believed,
                  const FollowOptions& options, const PidGains& gains, const Chassis& chassis,
                  double period_s) {
  while (!goal_of(follower, waypoints).stop && follower.next + 1 < waypoints.size() &&
         is_passed(follower, waypoints, believed.position, options)) {
    pass_by(follower, waypoints);
  }
  if (options.follower == "time_optimal") {
    if (const auto twist = along_timed_path(follower, waypoints, believed, options, chassis, period_s)) {
      follower.last = *twist;
      return {*twist, false};
    }
  }
  FollowStep wanted = options.mode == "holonomic"
                          ? holonomic(follower, waypoints, believed, options, gains, period_s)
                          : rotate_then_go(follower, waypoints, believed, options, gains, period_s);
  follower.last =
      wanted.there ? Twist2{} : limit_acceleration(wanted.twist, follower.last, options, period_s);
  wanted.twist = follower.last;
  return wanted;
}

void advance_to_next(Follower& follower, const std::vector<Waypoint>& waypoints) {
  Follower next;
  next.next = follower.next + 1;
  next.from = goal_of(follower, waypoints).pose;
  next.last = follower.last;
  follower = std::move(next);
}

}  // namespace outrider
