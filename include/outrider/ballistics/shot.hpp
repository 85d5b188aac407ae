// Shots: what one does, how much error it forgives, and the best one from a place.
#pragma once

#include <memory>
#include <optional>

#include "outrider/ballistics/contact.hpp"
#include "outrider/ballistics/target.hpp"
#include "outrider/world/height_field.hpp"

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
  Air air;
  std::shared_ptr<const HeightField> terrain;  ///< ground that is not flat (stance.hpp), instead of the floor
};

/// The flight of a shot under these rules, in air until it is 1 m below the floor and the target. `accuracy`
/// is AirTrack's (air.hpp).
Flight launch(const ShotRules& rules, const Platform& from, const Target& target, const Shot& shot,
              double accuracy = 5e-8);

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
/// forgives; below 1 a shot aimed at the centre still touches the box, to first order in each error alone.
double error_ratio(const ShotRules& rules, const Target& target, Vec2 position, const Shot& shot);

/// The angles that the joints of the gun make.
struct GunAngles {
  double yaw_rad = 0.0;    ///< in the frame of the ground (stance.hpp)
  double pitch_rad = 0.0;  ///< between the barrel and the tangent plane
};

struct PlannedShot {
  Shot shot;
  GunAngles gun;             ///< of the joints for it (stance.hpp); on level ground the shot's own
  double flight_s = 0.0;     ///< until the ball touches the target
  Vec3 contact;              ///< centre of the ball then
  double clearance_m = 0.0;  ///< of the flight until then, cut off at 1 m
  double error_ratio = 0.0;  ///< as above, and how far off the centre the aim is (1: at the edge)
  bool survives = false;     ///< the eight extreme combinations of the errors hit as well
  double hit_rate = 0.0;  ///< part of the shots that hit under errors within the bounds; taken for 1 when it
                          ///< survives, else over the midpoints of 27 equal parts of the box of errors
};

/// The soonest of the shots from `position` that forgive enough. Of the shots at the target's centre,
/// with pitches every half degree, those with a error_ratio of at most 0.7 come first, by the time to bring
/// the barrel there from `pitch_rad` and to fly, then the others by their error_ratio. They are flown exactly
/// in that order until one keeps the margin and survives all extreme errors. After 48 that keep the margin
/// only, 19 aim points around the centre are tried in the same way (the first 200 shots, if one at the
/// centre does keep it), and the shot with the highest hit
/// rate of the first four of either kind is taken. When none keeps the margin, the pitches and aim points
/// of exhaust() (firing_region.hpp) are tried. Nothing when none of those keeps it either.
std::optional<PlannedShot> best_shot(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                     Vec2 position, double pitch_rad);

}  // namespace outrider
