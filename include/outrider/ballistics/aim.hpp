// Aiming where no closed formula gives the yaw and the speed of a shot that passes a point: in air, or from a
// driving robot, also on a slope. The pitch is that of the barrel in the world.
#pragma once

#include <optional>

#include "outrider/ballistics/shot.hpp"

namespace outrider {

/// The position of a ball some time after the shot, and its derivatives with respect to the shot.
struct Arrival {
  Vec3 position;
  Vec3 velocity_mps;
  Vec3 by_speed;  ///< derivative of the position by the muzzle speed, m per m/s
  Vec3 by_yaw;    ///< derivative by the yaw, m/rad
  Vec3 by_pitch;  ///< derivative by the pitch, m/rad
};

/// Returns the arrival of a shot after a time. Exact without air. In air, integrates the motion together with
/// the linear equations of the derivatives by a Runge-Kutta method in steps of at most 0.05 s. The error is
/// below 10 micrometres for balls that fly 2 s at up to 15 m/s with a drag of 0.1 1/m. O(time).
Arrival arrival(const ShotRules& rules, const Platform& from, const Shot& shot, double time_s);

/// A shot that passes a given point.
struct Aimed {
  Shot shot;
  double flight_s = 0.0;  ///< time until the ball is at the point
  Arrival at;             ///< arrival at the point
};

/// Returns the shot at that pitch that passes `point` (world), to 1 micrometre of arrival(). Uses Newton's
/// method on speed, yaw and time, starting from `guess` (the result for a close point or pitch) or from the
/// parabola of a robot at rest. Returns nothing if the method does not converge in 20 steps, needs more than
/// the maximum speed of the gun, or reaches twice that speed on the way.
std::optional<Aimed> aim_through(const ShotRules& rules, const Platform& from, double pitch_rad, Vec3 point,
                                 const Aimed* guess = nullptr);

/// Returns error_ratio() (shot.hpp) of a shot aimed at the centre of the target.
double error_ratio(const ShotRules& rules, const Target& target, const Aimed& aimed);

}  // namespace outrider
