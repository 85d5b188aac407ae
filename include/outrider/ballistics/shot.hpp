// Shots: the flight of a shot, its tolerance of errors, and the search for the best shot from a place.
#pragma once

#include <memory>
#include <optional>

#include "outrider/ballistics/contact.hpp"
#include "outrider/ballistics/target.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

/// Bounds on the errors of a shot. The true errors are uniform within these bounds.
struct AimErrors {
  double gun_rad = 0.01;      ///< error of yaw and of pitch
  double speed_ratio = 0.01;  ///< relative error of the muzzle speed
};

/// The requirements for a planned shot.
struct ShotRules {
  GunModel gun;
  AimErrors errors;
  double gravity_mps2 = 9.8;
  double floor_z_m = 0.0;
  double standoff_m = 0.26;              ///< least distance from the yaw axis to the target's footprint
  double margin_m = 0.03;                ///< least distance from the ball to every solid before the contact
  double pitch_step_rad = radians(2.5);  ///< spacing of the pitches that are tried
  double aim_step_m = 0.05;  ///< spacing of the aim points that are tried before a target is given up
  Air air;
  std::shared_ptr<const HeightField> terrain;  ///< uneven ground (stance.hpp); null: the flat floor
};

/// Returns the flight of a shot under these rules. In air, the flight is computed until it is 1 m below the
/// floor and the target. `accuracy` is that of AirTrack (air.hpp).
Flight launch(const ShotRules& rules, const Platform& from, const Target& target, const Shot& shot,
              double accuracy = 5e-8);

/// Returns true if the robot at `position` keeps the standoff distance from the target.
bool clear_of(const ShotRules& rules, const Target& target, Vec2 position);

/// The end of a flight.
struct Impact {
  bool hit = false;  ///< the target was touched before anything else
  double time_s = 0.0;
  Vec3 position;                     ///< centre of the ball
  std::optional<std::size_t> solid;  ///< solid that was touched first; unset if the ball fell below the floor
};

/// Follows a flight to its first contact with the target or a solid of the space.
Impact fly(const Flight& flight, double ball_radius_m, const FlightSpace& space, const Target& target,
           double floor_z_m);

/// Returns the largest deviation at the target caused by the errors, divided by the deviation that the size
/// of the target permits. If it is below 1, a shot aimed at the centre still touches the box, to first order
/// and for each error alone.
double error_ratio(const ShotRules& rules, const Target& target, Vec2 position, const Shot& shot);

/// Joint angles of the gun.
struct GunAngles {
  double yaw_rad = 0.0;    ///< in the frame of the ground (stance.hpp)
  double pitch_rad = 0.0;  ///< between the barrel and the tangent plane
};

/// A shot with its predicted result.
struct PlannedShot {
  Shot shot;
  GunAngles gun;             ///< joint angles for the shot (stance.hpp); on level ground, those of the shot
  double flight_s = 0.0;     ///< time until the ball touches the target
  Vec3 contact;              ///< centre of the ball at the contact
  double clearance_m = 0.0;  ///< least clearance of the flight until the contact, cut off at 1 m
  double error_ratio =
      0.0;  ///< error_ratio(), plus the offset of the aim point from the centre (1: at the edge)
  bool survives = false;  ///< the shot also hits under all eight extreme combinations of the errors
  /// Fraction of shots that hit under random errors. 1 if `survives`; else computed over the midpoints of 27
  /// equal parts of the box of errors.
  double hit_rate = 0.0;
};

/// Returns the soonest robust shot from `position`, or nothing if no shot keeps the margin.
///
/// The search has three stages.
///  1. Shots at the centre of the target, with pitches every half degree. Shots with an error_ratio of at
///     most 0.7 come first, sorted by the time to pitch the barrel from `pitch_rad` plus the flight time;
///     then the others, sorted by error_ratio. Each is simulated exactly, and the first that keeps the margin
///     and hits under all extreme errors is returned.
///  2. After 48 shots that keep the margin only, 19 aim points around the centre are tried in the same way
///     (at most 200 shots, if a shot at the centre keeps the margin). If none is robust, the result is the
///     shot with the highest hit rate among the first four of either stage.
///  3. If no shot keeps the margin, the pitches and aim points of exhaust() (firing_region.hpp) are tried.
std::optional<PlannedShot> best_shot(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                     Vec2 position, double pitch_rad);

}  // namespace outrider
