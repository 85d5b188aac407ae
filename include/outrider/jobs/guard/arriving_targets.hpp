// ArrivingTargets: the intruders inside a yard that others keep entering, and the planning of stop tasks for
// them.
//
// Between two commands the policy may request a new plan for the intruders inside. A new plan never aborts an
// action: a drive continues to its next waypoint, where the robot stops anyway; an aimed shot is fired; and a
// started visit to a station is completed. The stop tasks (stop_tasks.hpp) do the rest: they solve each shot
// again from the true position, repeat misses, and make a second pass at the end.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/arrivals.hpp"
#include "outrider/jobs/guard/policy.hpp"
#include "outrider/jobs/guard/stop_table.hpp"
#include "outrider/jobs/guard/stop_tasks.hpp"

namespace outrider {

/// The inputs of the planning. Planning uses only the intruders that were observed so far.
struct ArrivalPlan {
  const ArrivalYard& yard;
  const PrecomputedStops& stops;
  ReplanPolicy policy;                                         ///< when to plan anew
  ArrivalObjective objective = ArrivalObjective::time_inside;  ///< what plans minimise
  std::size_t group = 3;                                       ///< as in ArrivalOptions
  std::size_t beam = 100;                                      ///< as in ArrivalOptions
};

/// The intruders known so far.
struct ArrivingTargets {
  std::vector<TargetArrival> inside;  ///< observed and not done, in the order of entering
  std::size_t entered = 0;            ///< how many entered since the last plan
  std::int64_t plans = 0;             ///< number of plans made
  std::int64_t survived = 0;          ///< number of hits that the intruder survived
};

/// Makes stop tasks with an empty queue and one record per intruder.
StopTasks tasks_of(const ArrivalPlan& plan);

/// Updates the list of intruders inside: adds those that have entered, removes those that are done.
void note_arrivals(ArrivingTargets& targets, StopTasks& tasks, const Observation& seen,
                   const ArrivalPlan& plan);

/// Returns the next command, or nothing when all intruders are done and no more will come. The plan is kept
/// until the policy requests a new one. No intruder is shot at before it is in its place. In the end each
/// intruder is reached, failed (after 2 `tries` shots, or without a shot from the places reached) or
/// unreachable.
std::optional<Command> next_command(ArrivingTargets& targets, StopTasks& tasks, const Observation& seen,
                                    const ArrivalPlan& plan);

}  // namespace outrider
