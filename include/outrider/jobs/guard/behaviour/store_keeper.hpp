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

#include "outrider/jobs/guard/mission/task_board.hpp"

namespace outrider {

/// The state of the store keeper.
class StoreKeeper {
 public:
  /// Returns a store that does not suffice for a command of the board and for the path to a charger after it;
  /// nothing if all stores suffice. Shortens a wait to the time that the charge allows. O(stations) routes.
  [[nodiscard]] static std::optional<Store> lacking(Command& command, const TaskBoard& board,
                                                    const Observation& seen);
  /// Puts the nearest station that fills that store at the front of the queue. If none helps, the targets
  /// that cannot be served fail.
  void provide(TaskBoard& board, Store store, const Observation& seen);
  /// Updates the state with a command that is carried out.
  void note(const Command& command);

  [[nodiscard]] int detours() const { return detours_; }  ///< visits to stations that were not in the plan
  /// Returns why the mission is over, in a sentence without its full stop; empty: it is not.
  [[nodiscard]] const std::string& stranded() const { return stranded_; }

 private:
  int fills_ = 0;  // since the last shot or wait; at most six
  int detours_ = 0;
  std::string stranded_;
};

}  // namespace outrider
