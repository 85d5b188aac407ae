#include "outrider/control/steer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/geometry/polyline.hpp"

namespace outrider {
namespace {

constexpr double there_m = 0.01;
constexpr double least_aim_m = 2.0 * there_m;  // a point that is no farther off than there_m is not driven to

/// Returns the point of the path at that arc length.
Vec2 point_at(const std::vector<Vec2>& points, double along_m) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double leg = distance(points[i - 1], points[i]);
    if (along_m <= leg && leg > 0.0) return points[i - 1] + (along_m / leg) * (points[i] - points[i - 1]);
    along_m -= leg;
  }
  return points.back();
}

/// Returns the farthest point within the lookahead to which the robot can drive straight.
Vec2 aim(const PathProgress& path, Vec2 position, const Nearby& nearby, const RobotModel& robot,
         const SteerOptions& options) {
  constexpr int tries = 8;
  const double wanted = std::min(robot.radius_m + options.gap_m, nearby.clearance(position) - 1e-3);
  const auto ahead = [&](int i) {
    return point_at(path.points, path.along_m + std::max(options.lookahead_m * i / tries, least_aim_m));
  };
  for (int i = tries; i > 1; --i) {
    const Vec2 point = ahead(i);
    if (nearby.clearance(Segment{position, point}) >= wanted) return point;
  }
  return ahead(1);
}

/// Returns the twist towards a point, ignoring obstacles.
Twist2 towards(Vec2 point, double left_m, const Pose2& pose, const RobotModel& robot,
               const SteerOptions& options) {
  const Vec2 way = point - pose.position;
  if (norm(way) < there_m) return {};
  const double error = wrap_angle(heading_of(way) - pose.heading_rad), off = std::abs(error);
  const double braking = std::sqrt(1.6 * robot.turn_acceleration_radps2 * off);
  const double turn = std::min({robot.turn_rate_radps, braking, off / options.settle_s});
  const Twist2 turning{0.0, 0.0, std::copysign(turn, error)};
  if (off >= options.pivot_rad) return turning;
  // At most the speed at which the arc through the point needs no higher turn rate than `turn`.
  const double bend = 0.5 * turn * norm(way) / std::max(std::sin(std::min(off, 0.5 * pi)), 1e-9);
  const double stopping = std::sqrt(1.6 * robot.acceleration_mps2 * left_m);
  const double ahead =
      off > 1e-6 ? std::min({robot.speed_mps, bend, stopping}) : std::min(robot.speed_mps, stopping);
  return {ahead, 0.0, turning.turn_radps};
}

double approach(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

/// Returns the least clearance along the simulated motion of a command.
double predicted_clearance(const Pose2& pose, const Twist2& now, const Twist2& command, const Nearby& nearby,
                           const RobotModel& robot, double duration_s) {
  constexpr double step_s = 0.05;
  Pose2 at = pose;
  Twist2 twist = now;
  double least = nearby.clearance(at.position);
  for (double t = 0.0; t < duration_s; t += step_s) {
    // The second half simulates braking.
    const Twist2 wanted = t < 0.5 * duration_s ? command : Twist2{};
    twist.ahead_mps = approach(twist.ahead_mps, wanted.ahead_mps, robot.acceleration_mps2 * step_s);
    twist.turn_radps = approach(twist.turn_radps, wanted.turn_radps, robot.turn_acceleration_radps2 * step_s);
    at = moved(at, twist, step_s);
    least = std::min(least, nearby.clearance(at.position));
  }
  return least;
}

}  // namespace

std::vector<Option> describe(SteerOptions& options) {
  return {
      {"lookahead", "m", 0.01, 10.0, "how far ahead on its path it aims at most", &options.lookahead_m},
      {"gap", "m", 0.0, 10.0, "that a short cut leaves between robot and obstacles", &options.gap_m},
      {"least_gap", "m", 0.0, 10.0, "nearer to an obstacle it does not go", &options.least_gap_m},
      {"pivot", "deg", 1.0, 180.0, "it turns in place when it has to turn by more", &options.pivot_rad},
      {"settle", "s", 0.01, 10.0, "in which a small error of the heading is turned away", &options.settle_s},
      {"foresight", "s", 0.05, 10.0, "for which the way of a command is foreseen", &options.foresight_s},
  };
}

void advance_along(PathProgress& path, Vec2 position) {
  constexpr double window_m = 0.5;
  double before = 0.0, nearest = std::numeric_limits<double>::infinity(), found = path.along_m;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Vec2 leg = path.points[i] - path.points[i - 1];
    const double length = norm(leg), low = path.along_m - before, high = low + window_m;
    before += length;
    if (length == 0.0 || high < 0.0 || low > length) continue;
    const double on_leg = dot(position - path.points[i - 1], leg) / length;
    const double at = std::clamp(on_leg, std::max(low, 0.0), std::min(high, length));
    const double off = squared_norm(position - (path.points[i - 1] + (at / length) * leg));
    if (off >= nearest) continue;
    nearest = off;
    found = before - length + at;
  }
  path.along_m = found;
}

double remaining_m(const PathProgress& path) { return std::max(0.0, length_of(path.points) - path.along_m); }

Twist2 steer(const PathProgress& path, const Pose2& pose, const Twist2& now, const Nearby& nearby,
             const RobotModel& robot, const SteerOptions& options) {
  const double left_m = std::max(remaining_m(path), distance(pose.position, path.points.back()));
  if (left_m < there_m) return {};
  const Vec2 point = aim(path, pose.position, nearby, robot, options);
  Twist2 command = towards(point, left_m, pose, robot, options);
  const double needed =
      std::min(robot.radius_m + options.least_gap_m, nearby.clearance(pose.position) - 1e-4);
  for (int i = 0; i < 3; ++i) {
    if (predicted_clearance(pose, now, command, nearby, robot, options.foresight_s) >= needed) return command;
    command.ahead_mps *= 0.5;
  }
  return {0.0, 0.0, command.turn_radps};
}

}  // namespace outrider
