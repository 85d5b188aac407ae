// GunModel: a barrel on a yaw axis and a pitch joint, which meet at one point above the centre of the robot.
//
// The tip of the barrel is `tip_forward` ahead of the joint and `tip_up` above it, in the frame of the
// barrel, so the muzzle moves when the pitch changes. Pitch is measured up from the horizon. The barrel,
// and the parabola of a shot from rest, stay in the vertical plane of its yaw.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

/// Dimensions and limits of a gun.
struct GunModel {
  double pivot_height_m = 0.11;           ///< height of the joint above the floor
  double tip_forward_m = 0.255;           ///< distance of the tip ahead of the joint
  double tip_up_m = 0.042;                ///< distance of the tip above the joint, at pitch 0
  double pitch_low_rad = radians(-30.0);  ///< lowest pitch
  double pitch_high_rad = radians(45.0);  ///< highest pitch
  double pitch_rate_radps = pi / 6;       ///< pitch rate
  double yaw_rate_radps = pi;             ///< yaw rate
  double muzzle_speed_mps = 10.0;         ///< maximum muzzle speed
  double ball_radius_m = 0.01;            ///< radius of a ball of water
};

std::vector<Option> describe(GunModel& gun);

/// Returns the position of the muzzle at a pitch: (metres ahead of the yaw axis, metres above the floor).
Vec2 muzzle(const GunModel& gun, double pitch_rad);

/// Returns the distance of the tip from the joint: no part of the barrel is farther from the yaw axis, at any
/// yaw and pitch.
double barrel_reach(const GunModel& gun);

/// Returns the height above the floor that no ball in the barrel exceeds at any pitch of the gun.
double barrel_top(const GunModel& gun);

/// Returns the time to change yaw and pitch of the barrel, with both axes moving at once, s.
double aim_time(const GunModel& gun, double yaw_change_rad, double pitch_change_rad);

}  // namespace outrider
