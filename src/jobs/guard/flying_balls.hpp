// Balls that nobody waits for: shots fired during drives, and what becomes of them and of sure shots from
// stops.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/jobs/guard/stop_tasks.hpp"

namespace outrider {

/// Returns the place of the cell nearest to `here` among those at least `apart_m` away.
std::optional<Vec2> nearest_place(const FiringMap& firing_map, const std::vector<std::size_t>& cells,
                                  Vec2 here, double apart_m);

/// Returns what there is to say of a target that was never hit. Tries without a shot are no misses.
std::string missed(const TargetRecord& record);

/// Returns the shots to fire during the drive along `way` to the present task: at the targets that the task
/// has in passing, and at those by the way, which are taken off their stops. No more shots than the tank has.
/// Who has to be hit in passing and cannot gets a stop. Nothing if the robot first shoots from where it is:
/// that has become the present task.
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
