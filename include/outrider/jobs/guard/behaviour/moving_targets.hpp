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

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/jobs/guard/mission/task_board.hpp"
#include "outrider/jobs/guard/plan/stop_table.hpp"
#include "outrider/jobs/guard/yard/visit_map.hpp"

namespace outrider {

/// The preparation of a mission against moving targets.
struct MovingPlan {
  const GuardProblem& problem;
  const FiringMap& firing_map;
  VisitMap map;     ///< state of the map before the mission
  StopTable stops;  ///< for a yard whose targets are the regions of the map
  WanderOptions options;
  std::vector<double> longest_m;  ///< by target, no shot goes farther in air; empty without air
};

/// Computes from where the regions of a map can be hit. The regions count as targets of the size of the first
/// target. Faults: those of build_firing_map() and precompute_stops().
Outcome<MovingPlan> plan_moving(const GuardProblem& problem, const FiringMap& firing_map, const VisitMap& map,
                                const GuardOptions& options, const WanderOptions& wander,
                                const Budget& budget = {});

/// The knowledge of the moving targets, and the state of the strategy. Copies are independent; the plan must
/// outlive them.
class MovingTargets {
 public:
  explicit MovingTargets(const MovingPlan& plan);

  /// Returns a board without tasks.
  [[nodiscard]] TaskBoard board() const;
  /// Notes positions of the targets and the results of shots.
  void note(TaskBoard& board, const Observation& seen);
  /// Returns the next command, or nothing when all targets are hit or there was no hit for `patience`.
  std::optional<Command> propose(TaskBoard& board, const Observation& seen);

  [[nodiscard]] const MovingPlan& plan() const { return *plan_; }
  [[nodiscard]] const std::vector<Track>& tracks() const { return tracks_; }  ///< by target: as observed
  /// Return the target that the gun is aimed at, the chance of that shot, and where it should hit.
  [[nodiscard]] std::size_t aimed_at() const { return aimed_at_; }
  [[nodiscard]] double chance() const { return chance_; }
  [[nodiscard]] Vec2 expected_at() const { return expected_at_; }
  /// Returns the sum of the chances of all shots so far.
  [[nodiscard]] double expected_hits() const { return expected_hits_; }

 private:
  [[nodiscard]] bool is_wanted(const TaskBoard& board, std::size_t who) const;
  void note_seen(const Observation& seen);
  [[nodiscard]] double chance_of(std::size_t who, const LedShot& led, Vec2 position, Rng rng) const;
  std::optional<LedShot> likely_shot(const TaskBoard& board, const Observation& seen, const Rng& rng);
  [[nodiscard]] std::size_t best_stop(const TaskBoard& board, const Observation& seen, const Rng& rng) const;

  const MovingPlan* plan_;
  std::vector<Track> tracks_;
  VisitMap map_;                      // with what was learned
  std::vector<std::size_t> learned_;  // by target: number of positions of its track that the map includes
  std::size_t stop_ = 0;              // index of the stop where the robot stands
  std::size_t aimed_at_ = 0;
  bool aimed_ = false;
  double chance_ = 0.0;
  Vec2 expected_at_;
  double expected_hits_ = 0.0;
  std::uint64_t steps_ = 0;  // seeds the random futures of each step
};

}  // namespace outrider
