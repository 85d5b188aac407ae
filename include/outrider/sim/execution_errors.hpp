// ExecutionErrors: how far what a simulated gun robot does is off what it was told.
#pragma once

#include <vector>

#include "outrider/ballistics/stance.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// The largest errors; each true error is drawn uniformly within them.
struct ExecutionErrors {
  double position_m = 0.1;     ///< of the place where a drive ends
  double heading_rad = 0.005;  ///< of the heading there
  AimErrors aim;               ///< of the gun's joints and of the muzzle speed
  double timing_s = 0.02;      ///< of the moment at which a shot leaves a robot that drives
};
std::vector<Option> describe(ExecutionErrors& errors);

/// Uniform in the disk of that radius.
Vec2 in_disk(Rng& rng, double radius_m);

/// Where a drive over these waypoints ends when it should end `error` off the last one: there, or nearer to
/// it where an obstacle would have stopped the disk. On a slope (of the rules' terrain) the error lies on the
/// surface.
Vec2 strayed_goal(const std::vector<Vec2>& waypoints, double radius_m, const CollisionMap& ground,
                  const ShotRules& rules, Vec2 error);

/// The shot as it leaves the gun when that one was meant: both joints and the speed are off.
Shot strayed(const Shot& meant, const AimErrors& errors, Rng& rng, const Stance& stance = {});

}  // namespace outrider
