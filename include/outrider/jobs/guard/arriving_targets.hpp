// ArrivingTargets: who is inside a yard that intruders keep entering, and the stop tasks planned for them.
//
// Between two commands the policy may ask for a new plan for those who are inside. What is under way is never
// dropped: a drive goes on to its next waypoint, where the robot halts anyway, once the gun is aimed the shot
// is fired, and a visit to a station is made. Everything else (shots solved again from where the robot really
// is, misses tried again, a second pass at the end) is done by the stop tasks (stop_tasks.hpp).
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/arrivals.hpp"
#include "outrider/jobs/guard/policy.hpp"
#include "outrider/jobs/guard/precomputed_stops.hpp"
#include "outrider/jobs/guard/stop_tasks.hpp"

namespace outrider {

/// What is planned with. Of the intruders only those are looked at that have been seen.
struct ArrivalPlan {
  const ArrivalYard& yard;
  const PrecomputedStops& stops;
  ReplanPolicy policy;
  ArrivalObjective objective = ArrivalObjective::time_inside;
  std::size_t group = 3;
  std::size_t beam = 100;
};

struct ArrivingTargets {
  std::vector<TargetArrival> inside;  ///< seen and not done, in the order of entering
  std::size_t entered = 0;            ///< of these, since the last plan
  std::int64_t plans = 0;             ///< made so far
  std::int64_t survived = 0;          ///< hits after which somebody went elsewhere
};

/// No tasks yet: one record an intruder.
StopTasks tasks_of(const ArrivalPlan& plan);

/// Those who have just entered are inside now; those who are done are not.
void note_arrivals(ArrivingTargets& targets, StopTasks& tasks, const Observation& seen,
                   const ArrivalPlan& plan);

/// The next command, or nothing when everybody is done and nobody comes any more. Without a policy's call the
/// plan is kept; an intruder is not shot at before it is in its place. Every intruder ends as reached, failed
/// (2 `tries` shots, or no shot from the places got to) or unreachable.
std::optional<Command> next_command(ArrivingTargets& targets, StopTasks& tasks, const Observation& seen,
                                    const ArrivalPlan& plan);

}  // namespace outrider
