// Stops for targets that cannot be hit as planned: in passing, or by a ball that hit nothing.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/stop_tasks.hpp"

namespace outrider {

/// Returns the place of the cell nearest to `here` among those at least `apart_m` away.
std::optional<Vec2> nearest_place(const FiringMap& firing_map, const std::vector<std::size_t>& cells,
                                  Vec2 here, double apart_m);

/// Lets a target be shot at from the first of the stops to come from which it is a sure hit; without any,
/// from a stop at the shortest detour after the present one.
void stop_for(StopTasks& tasks, std::size_t record, const GuardProblem& problem, const FiringMap& firing_map);

/// Makes a new present task for records that cannot be hit on the drive to the present one, and from no stop
/// to come: to shoot from where the robot stands at all that it hits from there for sure; or else to stop on
/// the way for the first that is worth it, if that is the shorter detour and takes no planned shot away.
/// Returns false if there is nobody like that.
bool stops_first(StopTasks& tasks, const std::vector<std::size_t>& records, const Observation& seen,
                 const GuardProblem& problem, const FiringMap& firing_map);

}  // namespace outrider
