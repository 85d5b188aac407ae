#include "outrider/motion/chassis.hpp"

#include <cmath>

#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

/// Projects the wheel speeds on one column of the chassis matrix.
double along(const Chassis& chassis, double Wheel::* column, const WheelSpeeds4& speeds) {
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < chassis.wheels.size(); ++i) {
    const double factor = chassis.wheels[i].*column;
    product += factor * speeds[i];
    square += factor * factor;
  }
  return square > 0.0 ? product / square : 0.0;
}

}  // namespace

bool Chassis::moves_sideways() const {
  for (const Wheel& wheel : wheels) {
    if (wheel.per_left != 0.0) return true;
  }
  return false;
}

Chassis differential_chassis(double wheel_radius_m, double half_track_m) {
  const double r = 1.0 / wheel_radius_m;
  return {"differential", {{"left", r, 0.0, -r * half_track_m}, {"right", r, 0.0, r * half_track_m}}};
}

Chassis mecanum_chassis(double wheel_radius_m, double half_size_m) {
  const double r = 1.0 / wheel_radius_m;
  const double l = r * half_size_m;
  return {"mecanum",
          {{"front_left", r, -r, -l},
           {"front_right", r, r, l},
           {"back_left", r, r, -l},
           {"back_right", r, -r, l}}};
}

Chassis holonomic_chassis(double wheel_radius_m, double ring_radius_m) {
  Chassis chassis{"holonomic", {}};
  const std::string_view names[] = {"front", "back_left", "back_right"};
  for (int i = 0; i < 3; ++i) {
    const Vec2 rolls = perpendicular(direction(radians(120.0 * i)));
    chassis.wheels.push_back(
        {names[i], rolls.x / wheel_radius_m, rolls.y / wheel_radius_m, ring_radius_m / wheel_radius_m});
  }
  return chassis;
}

Outcome<Chassis> make_chassis(std::string_view kind, double wheel_radius_m, double reach_m) {
  if (kind == "differential") return differential_chassis(wheel_radius_m, reach_m);
  if (kind == "mecanum") return mecanum_chassis(wheel_radius_m, reach_m);
  if (kind == "holonomic") return holonomic_chassis(wheel_radius_m, reach_m);
  return no_such_row("chassis", kind, {"differential", "mecanum", "holonomic"}, "chassis");
}

WheelSpeeds4 wheel_speeds(const Chassis& chassis, const Twist2& twist) {
  WheelSpeeds4 speeds{};
  for (std::size_t i = 0; i < chassis.wheels.size(); ++i) {
    const Wheel& wheel = chassis.wheels[i];
    speeds[i] = wheel.per_ahead * twist.ahead_mps + wheel.per_left * twist.left_mps +
                wheel.per_turn * twist.turn_radps;
  }
  return speeds;
}

Twist2 twist_of(const Chassis& chassis, const WheelSpeeds4& speeds) {
  return {along(chassis, &Wheel::per_ahead, speeds), along(chassis, &Wheel::per_left, speeds),
          along(chassis, &Wheel::per_turn, speeds)};
}

}  // namespace outrider
