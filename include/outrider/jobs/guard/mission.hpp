// GuardMission: the mission of a guard robot, with the capabilities that its task uses.
//
//   stop tasks (stop_tasks.hpp): always; drives to the stops, solves each shot again, repeats misses
//   arrivals (arriving_targets.hpp): for intruders that keep coming or survive; plans the tasks anew
//   walkers (moving_targets.hpp): for intruders that walk about; aims ahead of them
//   supplies (store_keeper.hpp): for limited water and battery; visits stations in time
//
// capabilities.hpp defines which of them combine, and with which properties of yard and robot.
#pragma once

#include <optional>

#include "outrider/jobs/guard/arriving_targets.hpp"
#include "outrider/jobs/guard/moving_targets.hpp"
#include "outrider/jobs/guard/stop_tasks.hpp"
#include "outrider/jobs/guard/store_keeper.hpp"

namespace outrider {

/// A Mission (robot/mission.hpp). All constructor arguments must outlive it. It is deterministic, and it ends
/// if the number of intruders is finite: after each appearance or survival a target gets at most 2 `tries`
/// shots, and there are at most six fills between two shots or waits.
class GuardMission {
 public:
  /// Makes a mission against targets that stand still from the start.
  GuardMission(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan);
  /// Makes a mission against intruders that arrive one after another, or may survive.
  explicit GuardMission(const ArrivalPlan& plan);
  explicit GuardMission(const ArrivalPlan&& plan) = delete;
  /// Makes a mission against intruders that walk about.
  explicit GuardMission(const MovingPlan& plan);
  explicit GuardMission(const MovingPlan&& plan) = delete;

  /// Returns the next command, or nothing when the mission is over. The observation must contain the store
  /// levels if stores are limited, and the target report if intruders arrive or walk. The budget is that of
  /// each search for a way.
  std::optional<Command> step(const Observation& seen, const Budget& budget = {});

  [[nodiscard]] const GuardProblem& problem() const { return *problem_; }
  [[nodiscard]] const FiringMap& firing_map() const { return *firing_map_; }
  /// Return the plan that the mission was made of; the other two are null.
  [[nodiscard]] const GuardPlan* tour() const { return tour_; }
  [[nodiscard]] const ArrivalPlan* arrivals() const { return arrivals_; }
  [[nodiscard]] const MovingPlan* walkers() const { return walkers_; }

  StopTasks tasks;           ///< stops to make, with the record of each target
  ArrivingTargets arriving;  ///< used if intruders arrive or survive
  MovingTargets moving;      ///< used if intruders walk about
  StoreKeeper stores;        ///< used if stores are limited

 private:
  void note(const Observation& seen);
  std::optional<Command> propose(const Observation& seen);

  const GuardProblem* problem_;
  const FiringMap* firing_map_;
  const GuardPlan* tour_ = nullptr;
  const ArrivalPlan* arrivals_ = nullptr;
  const MovingPlan* walkers_ = nullptr;
};

}  // namespace outrider
