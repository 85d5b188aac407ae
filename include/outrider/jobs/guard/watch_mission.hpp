// The execution of a watch: a pure step for a yard in which intruders keep coming.
//
// Between two commands the policy may ask for a new plan for those who are inside. What is in hand is
// never dropped: a drive goes on to its next waypoint, where the robot halts anyway, and once the gun is
// aimed the shot is fired. Everything else (shots solved again from where the robot really is, misses
// tried again, a second pass at the end) is a guard mission's (guard_mission.hpp), whose errands the plan
// sets.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/arrivals.hpp"
#include "outrider/jobs/guard/guard_mission.hpp"
#include "outrider/jobs/guard/outlook.hpp"
#include "outrider/jobs/guard/policy.hpp"

namespace outrider {

/// What a watch is planned with. Of the intruders only those are looked at that have been seen.
struct WatchPlan {
  const Watch& watch;
  const Outlook& outlook;
  WatchPolicy policy;
  WatchObjective objective = WatchObjective::time_inside;
  std::size_t group = 3;
  std::size_t beam = 100;
};

struct WatchMission {
  GuardMission guard;            ///< one record an intruder
  std::vector<TargetArrival> inside;  ///< seen and not done, in the order of entering
  std::size_t entered = 0;       ///< of these, since the last plan
  std::int64_t plans = 0;        ///< made so far
  std::int64_t survived = 0;     ///< hits after which somebody went elsewhere
};

WatchMission begin(const WatchPlan& plan);

/// The next command, or nothing when everybody is done and nobody comes any more. Changes `mission` only.
/// Without a policy's call the plan is kept; an intruder is not shot at before it is in its place. Every
/// intruder ends as reached, failed (2 `tries` shots, or no shot from the places got to) or unreachable.
std::optional<Command> step(WatchMission& mission, const Observation& seen, const WatchPlan& plan);

}  // namespace outrider
