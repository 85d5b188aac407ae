#include "outrider/motion/limited_twist.hpp"

#include <algorithm>

namespace outrider {
namespace {

double nearer_by(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

}  // namespace

Twist2 twist_after(const Twist2& now, const Twist2& commanded, const RobotModel& robot, double duration_s) {
  const double ahead = std::clamp(commanded.ahead_mps, -robot.speed_mps, robot.speed_mps);
  const double turn = std::clamp(commanded.turn_radps, -robot.turn_rate_radps, robot.turn_rate_radps);
  return {nearer_by(now.ahead_mps, ahead, robot.acceleration_mps2 * duration_s), 0.0,
          nearer_by(now.turn_radps, turn, robot.turn_acceleration_radps2 * duration_s)};
}

Pose2 moved_evenly(const Pose2& from, const Twist2& begin, const Twist2& end, double duration_s) {
  const double way_m = 0.5 * (begin.ahead_mps + end.ahead_mps) * duration_s;
  const double turned_rad = 0.5 * (begin.turn_radps + end.turn_radps) * duration_s;
  return {from.position + way_m * direction(from.heading_rad + 0.5 * turned_rad),
          from.heading_rad + turned_rad};
}

}  // namespace outrider
