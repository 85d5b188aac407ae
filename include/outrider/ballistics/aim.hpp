// Aim: the yaw and the speed of a shot that passes a point, where no formula gives them: in air, or from a
// robot that drives.
#pragma once

#include <optional>

#include "outrider/ballistics/shot.hpp"

namespace outrider {

/// Where the ball of a shot is some time after it left, and how that place changes with the shot.
struct Arrival {
  Vec3 position;
  Vec3 velocity_mps;
  Vec3 by_speed;  ///< change of the position by the muzzle speed, m per m/s
  Vec3 by_yaw;    ///< m/rad
  Vec3 by_pitch;  ///< m/rad
};

/// Exact without air; else by Runge and Kutta's method in steps of at most 0.05 s, together with the linear
/// equations of the changes; off by less than 10 micrometres for balls that fly 2 s at up to 15 m/s with a
/// drag of 0.1 1/m. O(time).
Arrival arrival(const ShotRules& rules, const Platform& from, const Shot& shot, double time_s);

struct Aimed {
  Shot shot;
  double flight_s = 0.0;  ///< until the ball is at the point
  Arrival at;             ///< there
};

/// The shot at that pitch that passes `point` (world), to 1 micrometre of arrival(). Newton's method on
/// speed, yaw and time, from `guess` (the answer for a point or a pitch close by) or from the parabola that a
/// robot at rest would shoot. Nothing when it does not get there in 20 steps, needs more than the gun's
/// speed, or asks for twice that on the way.
std::optional<Aimed> aim_through(const ShotRules& rules, const Platform& from, double pitch_rad, Vec3 point,
                                 const Aimed* guess = nullptr);

/// error_ratio() (shot.hpp) of a shot that is aimed at the target's centre.
double error_ratio(const ShotRules& rules, const Target& target, const Aimed& aimed);

}  // namespace outrider
