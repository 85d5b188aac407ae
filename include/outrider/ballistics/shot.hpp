// Shots: what one does, how much error it forgives, and the best one from a place.
#pragma once

#include <optional>

#include "outrider/ballistics/contact.hpp"
#include "outrider/ballistics/target.hpp"

namespace outrider {

/// Largest errors with which a shot leaves the gun; the true error is uniform within them.
struct AimErrors {
  double gun_rad = 0.01;      ///< of yaw and of pitch
  double speed_ratio = 0.01;  ///< of the muzzle speed
};

/// What a planned shot must keep to.
struct ShotRules {
  GunModel gun;
  AimErrors errors;
  double gravity_mps2 = 9.8;
  double floor_z_m = 0.0;
  double standoff_m = 0.26;              ///< from the yaw axis to the target's footprint
  double margin_m = 0.03;                ///< from the ball to every solid before the contact
  double pitch_step_rad = radians(2.5);  ///< of the pitches tried
  double aim_step_m = 0.05;              ///< of the points on a target tried before it is given up
};

/// True when the robot at `position` is clear of the target: standing on it is no way to hit it.
bool clear_of(const ShotRules& rules, const Target& target, Vec2 position);

/// The end of a flight.
struct Impact {
  bool hit = false;  ///< the target was touched before anything else
  double time_s = 0.0;
  Vec3 position;                     ///< centre of the ball
  std::optional<std::size_t> solid;  ///< the solid touched instead; nothing when lost below the floor
};

/// Follows a flight to its first contact with the target or a solid of the space.
Impact fly(const Flight& flight, double ball_radius_m, const FlightSpace& space, const Target& target,
           double floor_z_m);

/// Worst deviation at the target under the largest errors, as a part of what the target's size
/// forgives; below 1 a shot aimed at the centre still touches the box, to first order.
double spread(const ShotRules& rules, const Target& target, Vec2 position, const Shot& shot);

struct PlannedShot {
  Shot shot;
  double flight_s = 0.0;     ///< until the ball touches the target
  Vec3 contact;              ///< centre of the ball then
  double clearance_m = 0.0;  ///< of the flight until then, cut off at 1 m
  double spread = 0.0;
  bool survives = false;  ///< the eight extreme combinations of the errors hit as well
};

/// The soonest of the shots from `position` that forgive enough: over a fine lattice of pitches and aim
/// points, those with a spread of at most 0.7 come first, by the time to bring the barrel there from
/// `pitch_rad` and to fly, then the others by their spread. They are flown exactly in that order until
/// one keeps the margin and survives all extreme errors; else the first that keeps the margin is taken.
/// Nothing when no shot of the lattice does.
std::optional<PlannedShot> best_shot(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                     Vec2 position, double pitch_rad);

}  // namespace outrider
