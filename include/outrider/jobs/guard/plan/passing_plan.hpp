// Plans of a guard mission with shots in passing: a target that can be hit during a drive needs no stop.
#pragma once

#include <stop_token>

#include "outrider/jobs/guard/plan/plan.hpp"

namespace outrider {

/// Improves a plan: lets the gun turn during drives, waits for no ball that hits for sure, and moves shots
/// from stops to drives (passing.hpp), one shot or all shots of a stop at a time, as long as that makes the
/// mission shorter. Then it moves stops, to anywhere on free ground, where that shortens the drives, and
/// begins again. A stop without shots is removed, and the path past it is planned again. The result is never
/// longer than `plan`. Both lower bounds become 0, because those of a tour hold only for shots from rest;
/// mission_bound() has one for missions on the move. Stops at stations stay where they are, each tankful
/// serves the same targets as before, and the supplies suffice (supply_plan.hpp). A stop request ends the
/// search for shorter plans. A round tries O(hits + stops) changes, each with O(stops) drives and the shots
/// along those that are new.
GuardPlan shoot_in_passing(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                           const std::stop_token& stop = {});

}  // namespace outrider
