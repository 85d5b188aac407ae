#include "outrider/sim/bodies/wheels.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double along_per_s = 5.0;
constexpr double aside_per_m2 = 25.0;
constexpr double heading_per_s = 8.0;

}  // namespace

WheelBase wheel_base(const RobotModel& robot) {
  return {0.3 * std::min(robot.height_m, robot.radius_m), 0.6 * robot.radius_m};
}

WheelSpeeds follow(const Reference& reference, const Pose2& actual, const RobotModel& robot) {
  const Vec2 ahead = direction(actual.heading_rad);
  const Vec2 off = reference.pose.position - actual.position;
  const double heading_off = wrap_angle(reference.pose.heading_rad - actual.heading_rad);
  const double speed = reference.speed_mps * std::cos(heading_off) + along_per_s * dot(ahead, off);
  const double turn_rate = reference.turn_rate_radps +
                           aside_per_m2 * reference.speed_mps * cross(ahead, off) +
                           heading_per_s * heading_off;
  const WheelBase base = wheel_base(robot);
  const double along = std::clamp(speed, -robot.speed_mps, robot.speed_mps);
  const double difference =
      base.half_track_m * std::clamp(turn_rate, -robot.turn_rate_radps, robot.turn_rate_radps);
  return {(along - difference) / base.wheel_radius_m, (along + difference) / base.wheel_radius_m};
}

}  // namespace outrider
