#include "outrider/motion/limited_twist.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

double nearer_by(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

}  // namespace

Twist2 drivable(const Twist2& twist, const RobotModel& robot) {
  if (!robot.steers()) return twist;
  const double most = std::abs(twist.ahead_mps) / robot.turning_radius_m;
  return {twist.ahead_mps, 0.0, std::clamp(twist.turn_radps, -most, most)};
}

Twist2 twist_after(const Twist2& now, const Twist2& commanded, const RobotModel& robot, double duration_s) {
  const double ahead = std::clamp(commanded.ahead_mps, -robot.speed_mps, robot.speed_mps);
  double turn = std::clamp(commanded.turn_radps, -robot.turn_rate_radps, robot.turn_rate_radps);
  const double next = nearer_by(now.ahead_mps, ahead, robot.acceleration_mps2 * duration_s);
  if (robot.steers()) {
    const Twist2 curve = drivable(ahead != 0.0 ? Twist2{ahead, 0.0, turn} : now, robot);
    turn = curve.ahead_mps == 0.0 ? 0.0 : curve.turn_radps / curve.ahead_mps * next;
    turn = std::clamp(turn, -robot.turn_rate_radps, robot.turn_rate_radps);
  }
  const double change = robot.turn_acceleration_radps2 * duration_s;
  return drivable({next, 0.0, nearer_by(now.turn_radps, turn, change)}, robot);
}

Pose2 moved_evenly(const Pose2& from, const Twist2& begin, const Twist2& end, double duration_s) {
  const double way_m = 0.5 * (begin.ahead_mps + end.ahead_mps) * duration_s;
  const double turned_rad = 0.5 * (begin.turn_radps + end.turn_radps) * duration_s;
  return {from.position + way_m * direction(from.heading_rad + 0.5 * turned_rad),
          from.heading_rad + turned_rad};
}

}  // namespace outrider
