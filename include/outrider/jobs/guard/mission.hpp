// GuardMission: the one mission of a guard robot, with the capabilities that its task asks for.
//
//   stop tasks   (stop_tasks.hpp)        always: drive to the stops, solve each shot anew, try again
//   arrivals     (arriving_targets.hpp)  intruders keep coming, or survive: the tasks are planned anew
//   walkers      (moving_targets.hpp)    intruders walk about: shots lead them
//   supplies     (store_keeper.hpp)      water and battery are limited: stations come first when they must
//
// Which of them combine, and with which properties of yard and robot, is said by capabilities.hpp.
#pragma once

#include <optional>

#include "outrider/jobs/guard/arriving_targets.hpp"
#include "outrider/jobs/guard/moving_targets.hpp"
#include "outrider/jobs/guard/stop_tasks.hpp"
#include "outrider/jobs/guard/store_keeper.hpp"

namespace outrider {

/// A Mission (robot/mission.hpp). Everything that it was made of must outlive it. Deterministic. It ends,
/// when the intruders do: each target is shot at at most twice `tries` times for each of its lives, and
/// between two shots or waits there are at most six fills.
class GuardMission {
 public:
  /// All targets stand still from the start.
  GuardMission(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan);
  /// They come one after another, or may survive.
  explicit GuardMission(const ArrivalPlan& plan);
  explicit GuardMission(const ArrivalPlan&& plan) = delete;
  /// They walk about.
  explicit GuardMission(const MovingPlan& plan);
  explicit GuardMission(const MovingPlan&& plan) = delete;

  /// The next command, or nothing when the mission is over. Where the problem has limited stores, the
  /// observation has to tell their levels; where intruders come or walk, what the detector sees.
  std::optional<Command> step(const Observation& seen);

  StopTasks tasks;           ///< with the record of each target
  ArrivingTargets arriving;  ///< where they come or survive
  MovingTargets moving;      ///< where they walk about
  StoreKeeper stores;        ///< where stores are limited

 private:
  void note(const Observation& seen);
  std::optional<Command> propose(const Observation& seen);

  const GuardProblem* problem_;
  const FiringMap* site_;
  const ArrivalPlan* arrivals_ = nullptr;
  const MovingPlan* walkers_ = nullptr;
};

}  // namespace outrider
