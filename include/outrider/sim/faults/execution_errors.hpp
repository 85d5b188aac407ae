// ExecutionErrors: the errors with which a simulated gun robot carries out its commands.
#pragma once

#include <vector>

#include "outrider/ballistics/stance.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Bounds on the errors. Each true error is drawn uniformly within its bound.
struct ExecutionErrors {
  double position_m = 0.1;     ///< distance between the commanded and the true end of a drive
  double heading_rad = 0.005;  ///< error of the heading at the end of a drive
  AimErrors aim;               ///< errors of the gun's joints and of the muzzle speed
  double timing_s = 0.02;      ///< error of the firing time of a shot from a moving robot
};
std::vector<Option> describe(ExecutionErrors& errors);

/// Draws a vector uniformly from the disk of that radius.
Vec2 random_in_disk(Rng& rng, double radius_m);

/// Returns where a drive along the waypoints ends: `error` away from the last waypoint, or less if an
/// obstacle would stop the disk. On the terrain of the rules, the error is measured on the sloped surface.
Vec2 displaced_goal(const std::vector<Vec2>& waypoints, double radius_m, const CollisionMap& ground,
                    const ShotRules& rules, Vec2 error);

/// Returns the shot that the gun really fires if `meant` is commanded. Draws the errors of both joints and of
/// the muzzle speed.
Shot shot_with_errors(const Shot& meant, const AimErrors& errors, Rng& rng, const Stance& stance = {});

}  // namespace outrider
