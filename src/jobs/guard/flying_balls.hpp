// Balls that nobody waits for: shots fired during drives, and what becomes of them and of sure shots from
// stops.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/jobs/guard/stop_tasks.hpp"

namespace outrider {

/// Returns the waypoints that the robot would drive from one place to another; the first place alone if there
/// is no way. Fault: budget_exhausted if the planner has no budget (StopTasks::budget).
Outcome<std::vector<Vec2>> way_between(const StopTasks& tasks, const Pose2& from, Vec2 to,
                                       const GuardProblem& problem, const FiringMap& firing_map);

/// Returns what there is to say of a target that was never hit. Tries without a shot are no misses.
std::string missed(const TargetRecord& record);

/// Returns the shots to fire during the drive along `way` to the present task: at the targets that the task
/// has in passing, and at those by the way, which are taken off their stops. No more shots than the tank has.
/// Who has to be hit in passing and cannot gets a stop. Nothing if the robot first makes a stop for
/// them: that has become the present task.
std::optional<std::vector<FireInPassing>> shots_in_passing(StopTasks& tasks, const std::vector<Vec2>& way,
                                                           const Observation& seen,
                                                           const GuardProblem& problem,
                                                           const FiringMap& firing_map);

/// Notes what has become of the balls in the air.
void note_flying(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                 const FiringMap& firing_map);

/// Waits until the balls in the air have landed, then a little longer for results that are late. If time does
/// not go on meanwhile, their results count as lost.
std::optional<Wait> wait_for_balls(StopTasks& tasks, double time_s);

}  // namespace outrider
