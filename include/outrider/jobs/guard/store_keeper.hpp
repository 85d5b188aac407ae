// StoreKeeper: sees to it that a guard robot with limited water and battery never runs dry or strands.
//
// The plan's own visits to stations are stop tasks of the mission. Before each command of the mission the
// stores must suffice: for the drive, for one shot at its end, and for the way from there to the nearest
// charger, if there is one. A wait ends while the charge still suffices for that. Where they do not suffice,
// because shots missed, drives went astray or intruders keep coming, the nearest station that the robot can
// still get to comes first. A target for which full stores do not suffice has failed. When no such station is
// left, all targets that are still waiting have failed, and the mission is over.
#pragma once

#include <optional>
#include <string>

#include "outrider/jobs/guard/stop_tasks.hpp"

namespace outrider {

struct StoreKeeper {
  int fills = 0;          ///< since the last shot or wait; at most six
  int detours = 0;        ///< visits to stations that the plan did not have
  bool stranded = false;  ///< the mission is over
  std::string reason;     ///< why, in a sentence without its full stop
};

/// The store that does not suffice for a command that `tasks` led to and for what follows it; nothing when
/// all do. Shortens a wait to what the charge allows. O(stations) routes.
std::optional<Store> lacking(Command& command, const StopTasks& tasks, const Observation& seen,
                             const GuardProblem& problem, const FiringMap& firing_map);

/// Puts the nearest station with that store first in the queue, or settles the targets that go without.
void provide(StoreKeeper& keeper, StopTasks& tasks, Store store, const Observation& seen,
             const GuardProblem& problem, const FiringMap& firing_map);

/// Takes note of a command that is carried out.
void note_command(StoreKeeper& keeper, const Command& command);

}  // namespace outrider
