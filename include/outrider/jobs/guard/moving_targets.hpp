// MovingTargets: how a guard robot shoots at intruders that walk about (wander.hpp).
//
// Between two commands, in this order:
//  - A gun that is aimed is fired.
//  - For each intruder the shot that leads it is solved from here (moving_target.hpp), as if it went straight
//    on. It is flown at 32 of its possible futures (visit_map.hpp), with the errors of the gun drawn within
//    their bounds; the part that hits is its chance. Of those with at least `chance` the one that meets
//    soonest is taken.
//  - The robot goes to the stop with the least expected time to a shot: over 24 possible futures of all, the
//    time until it is there and somebody rests in a region that is hit from there, at most 60 s. It stays
//    where less than a second would be won.
//  - Else it waits for the next look.
// What is seen of them is learned from as it comes. A miss changes nothing but the time: all is solved anew.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/precomputed_stops.hpp"
#include "outrider/jobs/guard/stop_tasks.hpp"
#include "outrider/jobs/guard/visit_map.hpp"

namespace outrider {

/// What moving targets are shot at with.
struct MovingPlan {
  const GuardProblem& problem;
  const FiringMap& firing_map;
  VisitMap map;            ///< before the mission
  PrecomputedStops stops;  ///< of a yard whose targets are the regions of the map
  WanderOptions options;
  std::vector<double> longest_m;  ///< by target, no shot goes farther in air; empty without air
};

/// Surveys from where the regions of a map can be hit, by targets of the size of the first. Refused as
/// build_firing_map() and precompute_stops().
Outcome<MovingPlan> plan_moving(const GuardProblem& problem, const FiringMap& firing_map, const VisitMap& map,
                                const GuardOptions& options, const WanderOptions& wander,
                                const Budget& budget = {});

struct MovingTargets {
  std::vector<Track> tracks;  ///< by target, as seen
  VisitMap map;
  std::vector<std::size_t> learned;  ///< of each track, the positions that the map knows
  std::size_t stop = 0;              ///< of the plan, where the robot stands
  std::size_t aimed_at = 0;          ///< the target that the gun is aimed at
  double chance = 0.0;               ///< of the last shot aimed
  Vec2 expected_at;                  ///< and where the ball was to meet its target
  double last_hit_s = 0.0;           ///< or the start
  std::uint64_t steps = 0;           ///< each draws futures of its own
};

MovingTargets begin_moving(const MovingPlan& plan);

/// Takes note of what was seen, and of what became of the last shot.
void note_moving(MovingTargets& targets, StopTasks& tasks, const Observation& seen, const MovingPlan& plan);

/// The next command, or nothing when everybody is hit, or nobody was for `patience`.
std::optional<Command> next_command(MovingTargets& targets, StopTasks& tasks, const Observation& seen,
                                    const MovingPlan& plan);

}  // namespace outrider
