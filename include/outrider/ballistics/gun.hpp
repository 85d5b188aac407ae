// GunModel: a barrel on a yaw axis and a pitch joint, both at one point above the robot's centre.
//
// The tip is not on the joint's axis of sight: it stands `tip_forward` ahead and `tip_up` above the
// joint in the frame of the barrel, so the muzzle moves when the pitch changes. Pitch is up from the
// horizon. The barrel, and with it every flight, stays in the vertical plane of its yaw.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct GunModel {
  double pivot_height_m = 0.11;  ///< of the joint above the floor
  double tip_forward_m = 0.255;
  double tip_up_m = 0.042;
  double pitch_low_rad = radians(-30.0);
  double pitch_high_rad = radians(45.0);
  double pitch_rate_radps = pi / 6;
  double yaw_rate_radps = pi;
  double muzzle_speed_mps = 10.0;  ///< largest
  double ball_radius_m = 0.01;
};

std::vector<Option> describe(GunModel& gun);

/// The muzzle at a pitch: (metres ahead of the yaw axis, metres above the floor).
Vec2 muzzle(const GunModel& gun, double pitch_rad);

/// Time to bring the barrel from one yaw and pitch to another, both axes moving at once, s.
double aim_time(const GunModel& gun, double yaw_change_rad, double pitch_change_rad);

}  // namespace outrider
