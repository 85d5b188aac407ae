// Flight: the path of a ball. Without air it is a parabola; air.hpp computes the path in air.
//
// In the vertical plane of the flight, with s the distance from the muzzle and h the height of the muzzle,
//     z(s) = h + s tan(pitch) - k s^2,   k = g / (2 v^2 cos^2(pitch)).
// For a given pitch, one point of the path therefore determines the drop coefficient k and the speed v.
// Units: metres, seconds, radians.
#pragma once

#include <memory>
#include <optional>

#include "outrider/ballistics/air.hpp"
#include "outrider/ballistics/gun.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

/// A flight, as a function of the time since the ball left the muzzle.
struct Flight {
  Vec3 muzzle;        ///< centre of the ball at time 0, world frame
  Vec3 velocity_mps;  ///< velocity at time 0
  double gravity_mps2 = 9.8;
  std::shared_ptr<const AirTrack> in_air = nullptr;  ///< path in air; null: a parabola

  [[nodiscard]] Vec3 position(double time_s) const {
    if (in_air) return in_air->position(time_s);
    return muzzle + time_s * velocity_mps - Vec3{0, 0, 0.5 * gravity_mps2 * time_s * time_s};
  }
  [[nodiscard]] Vec3 velocity(double time_s) const {
    if (in_air) return in_air->velocity(time_s);
    return velocity_mps - Vec3{0, 0, gravity_mps2 * time_s};
  }
  /// Returns an upper bound on the magnitude of the acceleration.
  [[nodiscard]] double most_acceleration() const {
    return in_air ? in_air->most_acceleration() : gravity_mps2;
  }
};

/// A shot as commanded: the direction of the barrel and the muzzle speed.
struct Shot {
  double yaw_rad = 0.0;    ///< yaw of the barrel in the world frame
  double pitch_rad = 0.0;  ///< pitch of the barrel
  double speed_mps = 0.0;  ///< muzzle speed
};

/// The position and velocity of a robot when it fires.
struct Platform {
  Vec2 position;           ///< position of the yaw axis
  Vec2 velocity_mps;       ///< horizontal velocity
  double climb_mps = 0.0;  ///< vertical velocity, on a slope

  /// Returns the velocity, which adds to the muzzle velocity of the ball.
  [[nodiscard]] Vec3 velocity() const { return {velocity_mps.x, velocity_mps.y, climb_mps}; }
};

/// Returns the flight of a shot from a robot that stands at `position` on a floor of height `floor_z_m`.
Flight launch(const GunModel& gun, Vec2 position, double floor_z_m, const Shot& shot, double gravity_mps2);

/// Returns the muzzle speed with which a ball shot at `pitch_rad` passes a point `forward_m` ahead of the yaw
/// axis and `height_m` above the floor. Returns nothing if no speed does, or if it exceeds the maximum speed
/// of the gun.
std::optional<double> speed_through(const GunModel& gun, double pitch_rad, double forward_m, double height_m,
                                    double gravity_mps2);

}  // namespace outrider
