#include "outrider/ballistics/gun.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {

std::vector<Option> describe(GunModel& gun) {
  return {
      {"pivot_height", "m", 0.0, 100.0, "height of the yaw axis and pitch joint above the floor",
       &gun.pivot_height_m},
      {"tip_forward", "m", 0.0, 100.0, "distance of the tip ahead of the joint, along the barrel",
       &gun.tip_forward_m},
      {"tip_up", "m", -10.0, 10.0, "distance of the tip above the joint, across the barrel", &gun.tip_up_m},
      {"pitch_low", "deg", -89.0, 89.0, "lowest pitch", &gun.pitch_low_rad},
      {"pitch_high", "deg", -89.0, 89.0, "highest pitch", &gun.pitch_high_rad},
      {"pitch_rate", "rad/s", 1e-3, 1e3, "speed of the pitch joint", &gun.pitch_rate_radps},
      {"yaw_rate", "rad/s", 1e-3, 1e3, "speed of the yaw axis", &gun.yaw_rate_radps},
      {"muzzle_speed", "m/s", 0.1, 1e3, "largest speed of the ball as it leaves the muzzle",
       &gun.muzzle_speed_mps},
      {"ball_radius", "m", 1e-4, 1.0, "radius of the ball", &gun.ball_radius_m},
  };
}

Vec2 muzzle(const GunModel& gun, double pitch_rad) {
  const double c = std::cos(pitch_rad);
  const double s = std::sin(pitch_rad);
  return {gun.tip_forward_m * c - gun.tip_up_m * s,
          gun.pivot_height_m + gun.tip_forward_m * s + gun.tip_up_m * c};
}

double barrel_reach(const GunModel& gun) { return std::hypot(gun.tip_forward_m, gun.tip_up_m); }

double barrel_top(const GunModel& gun) {
  // The muzzle is highest where the line from the joint to it points straight up, or as near to that as it
  // gets.
  const double above = std::atan2(gun.tip_up_m, gun.tip_forward_m);
  const double pitch = std::clamp(0.5 * pi - above, gun.pitch_low_rad, gun.pitch_high_rad);
  return std::max(gun.pivot_height_m, muzzle(gun, pitch).y) + gun.ball_radius_m;
}

double aim_time(const GunModel& gun, double yaw_change_rad, double pitch_change_rad) {
  return std::max(std::abs(wrap_angle(yaw_change_rad)) / gun.yaw_rate_radps,
                  std::abs(pitch_change_rad) / gun.pitch_rate_radps);
}

}  // namespace outrider
