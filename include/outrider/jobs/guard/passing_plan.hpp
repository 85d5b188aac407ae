// Plans of a guard mission with shots in passing: a target that can be hit during a drive needs no stop.
#pragma once

#include <stop_token>

#include "outrider/jobs/guard/plan.hpp"

namespace outrider {

/// Improves a plan: lets the gun turn during drives, waits for no ball that hits for sure, and moves shots
/// from stops to drives (passing.hpp), one shot or all shots of a stop at a time, as long as that makes the
/// mission shorter. A stop without shots is removed, and the path past it is
/// planned again. The result is never longer than `plan`, with the cost counted in the same way. Both lower
/// bounds become moving_bound(), because the bounds of a tour hold only for shots from rest. The shots of a
/// plan over terrain or with stops at stations stay as they are. A stop request ends the search for shorter
/// plans. O(hits^2) candidate plans, each with O(stops) routes and its new shots.
GuardPlan shoot_in_passing(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                           const std::stop_token& stop = {});

/// Returns a lower bound on the time of every mission that hits those targets, from rest or in passing, from
/// anywhere. For each target it takes the time of a straight drive from rest until the target is within reach
/// of a ball that has the speeds of gun and robot added; the bound is the largest of these times. In air no
/// reach is proven, and the bound is 0. O(targets).
double moving_bound(const GuardProblem& problem, const FiringMap& firing_map,
                    const std::vector<std::size_t>& targets);

}  // namespace outrider
