// The plan of plan_guard() with a stronger lower bound of missions on the move, which counts turns and halts.
#pragma once

#include "outrider/jobs/guard/plan/plan.hpp"

namespace outrider {

/// Plans as plan_guard(). If the plan shoots on the move, both of its lower bounds are
/// heading_mission_bound(). Faults: those of plan_guard().
Outcome<GuardPlan> plan_with_heading_bound(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardOptions& options, const Budget& budget,
                                           const DraftObserver& observe);

/// Returns the larger of mission_bound() on the move and heading_bound() over the same targets, s. It holds
/// for all missions that mission_bound() on the move holds for, if the robot turns in place and drives
/// straight. It is mission_bound() where the yard is too large for the other. The arguments are those of
/// mission_bound(), but for `options.shoot_on_the_move`, which counts as true.
double heading_mission_bound(const GuardProblem& problem, const FiringMap& firing_map,
                             const std::vector<std::size_t>& targets, GuardOptions options,
                             const Budget& budget);

}  // namespace outrider
