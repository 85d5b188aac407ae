// What every guard planner begins and ends with.
#pragma once

#include "outrider/jobs/guard/plan.hpp"

namespace outrider {

/// A plan without stops: its places counted, the targets without a firing region told unreachable.
GuardPlan begin_plan(const GuardProblem& problem, const FiringMap& firing_map, const GuardOptions& options);

/// Returns true if the robot goes on while the ball of a shot from rest is in the air.
inline bool is_left_flying(const GuardPlan& plan, const PlannedShot& shot) {
  return plan.on_the_move && shot.survives;
}

/// Time of the plan if nothing goes wrong, until the last ball lands: turns, drives, aims and flights in
/// their order; on the move, aims and flights beside the drives.
double mission_time(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan);

/// Joins the stops, from the start on, by the drives that are fastest with the turn before them, and finds
/// the cost of the whole. Refused as yard_routes().
Status finish_plan(const GuardProblem& problem, const FiringMap& firing_map, const Budget& budget,
                   GuardPlan& plan);

}  // namespace outrider
