#include "outrider/ballistics/flight.hpp"

#include <cmath>

namespace outrider {

Flight launch(const GunModel& gun, Vec2 position, double floor_z_m, const Shot& shot, double gravity_mps2) {
  const Vec2 along = direction(shot.yaw_rad);
  const Vec2 tip = muzzle(gun, shot.pitch_rad);
  const Vec2 ground = position + tip.x * along;
  const double forward = shot.speed_mps * std::cos(shot.pitch_rad);
  return {{ground.x, ground.y, floor_z_m + tip.y},
          {forward * along.x, forward * along.y, shot.speed_mps * std::sin(shot.pitch_rad)},
          gravity_mps2};
}

std::optional<double> speed_through(const GunModel& gun, double pitch_rad, double forward_m, double height_m,
                                    double gravity_mps2) {
  const Vec2 tip = muzzle(gun, pitch_rad);
  const double s = forward_m - tip.x;
  if (s <= 0.0) return std::nullopt;
  const double drop = tip.y + s * std::tan(pitch_rad) - height_m;  // k s^2
  if (drop <= 0.0) return std::nullopt;
  const double cosine = std::cos(pitch_rad);
  const double speed = std::sqrt(gravity_mps2 * s * s / (2.0 * drop * cosine * cosine));
  if (speed > gun.muzzle_speed_mps) return std::nullopt;
  return speed;
}

}  // namespace outrider
