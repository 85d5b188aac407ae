// Flight: the path of a ball, a parabola where there is no air (air.hpp tells what it is otherwise).
//
// In its vertical plane, with s the distance from the muzzle and h the muzzle's height,
//     z(s) = h + s tan(pitch) - k s^2,   k = g / (2 v^2 cos^2(pitch)),
// so for a given pitch the drop coefficient k, and with it the speed v, is fixed by any one point
// of the path. Units: metres, seconds, radians.
#pragma once

#include <memory>
#include <optional>

#include "outrider/ballistics/air.hpp"
#include "outrider/ballistics/gun.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct Flight {
  Vec3 muzzle;        ///< centre of the ball as it leaves, world
  Vec3 velocity_mps;  ///< then
  double gravity_mps2 = 9.8;
  std::shared_ptr<const AirTrack> in_air = nullptr;  ///< its path where there is air; else a parabola

  [[nodiscard]] Vec3 position(double time_s) const {
    if (in_air) return in_air->position(time_s);
    return muzzle + time_s * velocity_mps - Vec3{0, 0, 0.5 * gravity_mps2 * time_s * time_s};
  }
  [[nodiscard]] Vec3 velocity(double time_s) const {
    if (in_air) return in_air->velocity(time_s);
    return velocity_mps - Vec3{0, 0, gravity_mps2 * time_s};
  }
  /// Bound of the acceleration's size.
  [[nodiscard]] double most_acceleration() const {
    return in_air ? in_air->most_acceleration() : gravity_mps2;
  }
};

/// What the gun is told: where the barrel points and how fast the ball leaves.
struct Shot {
  double yaw_rad = 0.0;  ///< of the barrel, in the world
  double pitch_rad = 0.0;
  double speed_mps = 0.0;
};

/// Where a robot is when it fires, and how it moves.
struct Platform {
  Vec2 position;      ///< of the yaw axis
  Vec2 velocity_mps;  ///< over the ground; the ball leaves with the barrel's velocity and this one
};

/// The flight of a shot from a robot that stands at `position` on a floor of height `floor_z_m`.
Flight launch(const GunModel& gun, Vec2 position, double floor_z_m, const Shot& shot, double gravity_mps2);

/// Muzzle speed with which a ball shot at `pitch_rad` passes a point `forward_m` ahead of the yaw axis
/// and `height_m` above the floor; nothing when that needs more than the gun's speed or no speed does.
std::optional<double> speed_through(const GunModel& gun, double pitch_rad, double forward_m, double height_m,
                                    double gravity_mps2);

}  // namespace outrider
