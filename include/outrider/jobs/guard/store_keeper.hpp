// StoreKeeper: sends a guard robot with limited water and battery to stations before a store runs empty.
//
// Visits to stations that are in the plan are ordinary stop tasks. Before each command, the stores must
// suffice for the drive, for one shot at its end, and for the path from there to the nearest charger, if
// there is one. A wait ends while the charge still suffices for that. If the stores do not suffice (after
// misses, drive errors or new intruders), the robot first goes to the nearest station that it can still
// reach. A target for which full stores do not suffice has failed. If no station can be reached, all waiting
// targets have failed, and the mission is over.
#pragma once

#include <optional>
#include <string>

#include "outrider/jobs/guard/stop_tasks.hpp"

namespace outrider {

/// The state of the store keeper.
struct StoreKeeper {
  int fills = 0;          ///< number of fills since the last shot or wait; at most six
  int detours = 0;        ///< number of visits to stations that were not in the plan
  bool stranded = false;  ///< the mission is over
  std::string reason;     ///< why, in a sentence without its full stop
};

/// Returns a store that does not suffice for a command of `tasks` and for the path to a charger after it;
/// nothing if all stores suffice. Shortens a wait to the time that the charge allows. O(stations) routes.
std::optional<Store> lacking(Command& command, const StopTasks& tasks, const Observation& seen,
                             const GuardProblem& problem, const FiringMap& firing_map);

/// Puts the nearest station that fills that store at the front of the queue. If none helps, the targets that
/// cannot be served fail.
void provide(StoreKeeper& keeper, StopTasks& tasks, Store store, const Observation& seen,
             const GuardProblem& problem, const FiringMap& firing_map);

/// Updates the state with a command that is carried out.
void note_command(StoreKeeper& keeper, const Command& command);

}  // namespace outrider
