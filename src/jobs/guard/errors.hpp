// The errors of a guard in simulation, drawn within the bounds of the problem; and the rule of the reference.
#pragma once

#include "outrider/ballistics/stance.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/site.hpp"

namespace outrider {

/// Uniform in the disk of that radius.
Vec2 in_disk(Rng& rng, double radius_m);

/// Where a drive over these waypoints ends when it should end `error` off the last one: there, or nearer to
/// it where an obstacle would have stopped the robot. On a slope the error lies on the surface.
Vec2 strayed_goal(const std::vector<Vec2>& waypoints, const GuardProblem& problem, const Site& site,
                  Vec2 error);

/// The shot as it leaves the gun when that one was meant: both joints and the speed are off.
Shot strayed(const Shot& meant, const AimErrors& errors, Rng& rng, const Stance& stance = {});

/// The reference report's own idea of a hit: the ball's centre comes within 0.5 m of the target's base.
bool hits_by_reference_rule(const Flight& flight, const Target& target, double until_s);

}  // namespace outrider
