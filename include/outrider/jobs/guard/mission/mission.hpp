// GuardMission: the mission of a guard robot, with the capabilities that its task uses.
//
// It is a board of tasks (task_board.hpp), which drives to the stops, solves each shot again and repeats
// misses, and behaviours that change it: one for what is known of the targets, with note() and propose(),
//
//   StillTargets: the targets stand still, and the tasks are those of the plan
//   ArrivingTargets (arriving_targets.hpp): intruders keep coming or survive; plans the tasks anew
//   MovingTargets (moving_targets.hpp): intruders walk about; aims ahead of them
//
// and StoreKeeper (store_keeper.hpp), which visits stations in time if water or battery are limited.
//
// capabilities.hpp defines which of them combine, and with which properties of yard and robot.
#pragma once

#include <optional>
#include <variant>

#include "outrider/jobs/guard/behaviour/arriving_targets.hpp"
#include "outrider/jobs/guard/behaviour/moving_targets.hpp"
#include "outrider/jobs/guard/behaviour/store_keeper.hpp"
#include "outrider/jobs/guard/mission/task_board.hpp"

namespace outrider {

/// Targets that stand still from the start.
struct StillTargets {
  const GuardPlan* plan;  ///< must outlive it

  static void note(TaskBoard& board, const Observation& seen) { board.note_shots(seen); }
  static std::optional<Command> propose(TaskBoard& board, const Observation& seen) {
    return board.next_command(seen);
  }
};

/// A Mission (robot/mission.hpp). All constructor arguments must outlive it. It is deterministic, and it ends
/// if the number of intruders is finite: after each appearance or survival a target gets at most 2 `tries`
/// shots, and there are at most six fills between two shots or waits.
class GuardMission {
 public:
  /// Makes a mission against targets that stand still from the start.
  GuardMission(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan);
  /// Makes a mission against intruders that arrive one after another, or may survive.
  explicit GuardMission(const RollingPlan& plan);
  explicit GuardMission(const RollingPlan&& plan) = delete;
  /// Makes a mission against intruders that walk about.
  explicit GuardMission(const MovingPlan& plan);
  explicit GuardMission(const MovingPlan&& plan) = delete;

  /// Returns the next command, or nothing when the mission is over. The observation must contain the store
  /// levels if stores are limited, and the target report if intruders arrive or walk. The budget is that of
  /// each search for a way.
  std::optional<Command> step(const Observation& seen, const Budget& budget = {});
  /// The two halves of a step: what was seen is noted; then the next command is found, which a copy may try.
  void note(const Observation& seen);
  std::optional<Command> next(const Observation& seen);

  [[nodiscard]] const TaskBoard& board() const { return board_; }
  [[nodiscard]] TaskBoard& board() { return board_; }
  [[nodiscard]] const StoreKeeper& stores() const { return stores_; }
  /// Return what is known of the targets; two of the three are null.
  [[nodiscard]] const GuardPlan* tour() const {
    const auto* const still = std::get_if<StillTargets>(&targets_);
    return still != nullptr ? still->plan : nullptr;
  }
  [[nodiscard]] const ArrivingTargets* arriving() const { return std::get_if<ArrivingTargets>(&targets_); }
  [[nodiscard]] const MovingTargets* moving() const { return std::get_if<MovingTargets>(&targets_); }

 private:
  std::optional<Command> propose(const Observation& seen);

  TaskBoard board_;
  std::variant<StillTargets, ArrivingTargets, MovingTargets> targets_;
  StoreKeeper stores_;
};

}  // namespace outrider
