// MovingTargets: the strategy of a guard robot against intruders that walk about (wander.hpp).
//
// The next command is the first of these that applies:
//  - If the gun is aimed, fire.
//  - Take a shot. For each intruder, solve the shot that leads it from here (moving_target.hpp), as if the
//    intruder went straight on. Simulate the shot against 32 possible futures of the intruder (visit_map.hpp)
//    with random gun errors; the fraction of hits is the chance of the shot. Of the shots with at least
//    `chance`, take the one that hits soonest.
//  - Drive to the stop with the least expected time to a shot. That time is the mean over 24 possible futures
//  of
//    the time until the robot is there and an intruder rests in a region that can be hit from there, at most
//    60 s. The robot stays where it is if it would gain less than one second.
//  - Wait for the next observation.
// The robot keeps learning from its observations. After a miss everything is solved again.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/stop_table.hpp"
#include "outrider/jobs/guard/stop_tasks.hpp"
#include "outrider/jobs/guard/visit_map.hpp"

namespace outrider {

/// The preparation of a mission against moving targets.
struct MovingPlan {
  const GuardProblem& problem;
  const FiringMap& firing_map;
  VisitMap map;            ///< state of the map before the mission
  PrecomputedStops stops;  ///< for a yard whose targets are the regions of the map
  WanderOptions options;
  std::vector<double> longest_m;  ///< by target, no shot goes farther in air; empty without air
};

/// Computes from where the regions of a map can be hit. The regions count as targets of the size of the first
/// target. Faults: those of build_firing_map() and precompute_stops().
Outcome<MovingPlan> plan_moving(const GuardProblem& problem, const FiringMap& firing_map, const VisitMap& map,
                                const GuardOptions& options, const WanderOptions& wander,
                                const Budget& budget = {});

/// What is known of the moving targets, and the state of the strategy.
struct MovingTargets {
  std::vector<Track> tracks;         ///< by target: observed positions
  VisitMap map;                      ///< the map with what was learned
  std::vector<std::size_t> learned;  ///< by target: number of positions of its track that the map includes
  std::size_t stop = 0;              ///< index of the stop where the robot stands
  std::size_t aimed_at = 0;          ///< index of the target that the gun is aimed at
  double chance = 0.0;               ///< chance of the last aimed shot
  Vec2 expected_at;                  ///< where the last aimed shot was expected to hit its target
  double last_hit_s = 0.0;           ///< time of the last hit; the start if there is none
  std::uint64_t steps = 0;           ///< number of steps; seeds the random futures of each step
};

/// Returns the state at the start of the mission.
MovingTargets begin_moving(const MovingPlan& plan);

/// Updates the state with an observation: positions of the targets and the result of the last shot.
void note_moving(MovingTargets& targets, StopTasks& tasks, const Observation& seen, const MovingPlan& plan);

/// Returns the next command, or nothing when all targets are hit or there was no hit for `patience`.
std::optional<Command> next_command(MovingTargets& targets, StopTasks& tasks, const Observation& seen,
                                    const MovingPlan& plan);

}  // namespace outrider
