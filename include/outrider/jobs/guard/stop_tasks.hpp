// StopTasks: the stops that a guard robot still has to make, and what became of each target.
//
// At each stop the shot is solved again from the pose actually reached, as the soonest from the pitch that
// the plan has for it: without errors it is the shot of the plan. A target that is missed `tries` times has
// failed. When all stops are done, targets that failed are tried once more from another place, and targets
// without a firing region once more with the clearance margin given up.
//
// Shots in passing (passing.hpp) are solved again when their way begins, for that way. A target that cannot
// be hit from it, or was missed, is shot at next from the nearest place to the end of the way.
#pragma once

#include <deque>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/jobs/guard/plan.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider {

enum class TargetStatus { waiting, reached, failed, unreachable };
std::string_view to_string(TargetStatus status);

/// What became of one target.
struct TargetRecord {
  TargetStatus status = TargetStatus::waiting;
  std::string reason;               ///< one sentence
  int shots = 0;                    ///< fired at it
  std::int64_t tries = 0;           ///< of the present pass: misses, and places without a shot
  std::optional<PlannedShot> shot;  ///< the last one solved
  Pose2 pose;                       ///< from where it was solved last, or could not be
  double done_s = 0.0;              ///< when the status became what it is
};

void settle(TargetRecord& record, TargetStatus status, std::string reason, double time_s);

/// A place to go to, and what to shoot from there, in order, or the store to fill there.
struct StopTask {
  Vec2 place;
  std::vector<std::size_t> targets = {};
  std::optional<StationCall> call = {};
  std::vector<std::size_t> passing = {};  ///< to shoot at on the way there
  std::vector<double> pitches = {};       ///< planned for the targets, of the gun, rad; empty: none are
};

struct StopTasks {
  std::vector<TargetRecord> records;      ///< by target
  std::deque<StopTask> queue;             ///< still to do; the first is the present one
  bool arrived = false;                   ///< at the place of the present task
  bool aimed = false;                     ///< the gun has been told where to point
  bool fired = false;                     ///< the last command was a shot
  std::vector<std::size_t> passing = {};  ///< shot at in passing by the last command
  bool second_pass = false;
  bool more_to_come = false;           ///< no second pass yet when the queue is empty
  Vec2 last_place;                     ///< where the robot was last sent
  std::vector<std::size_t> stands_at;  ///< by record: the target of the problem that stands for it now, where
                                       ///< that is not the one of its own index; empty: none has moved
  std::optional<Routes> routes;        ///< of the plan
  std::stop_token stop = {};           ///< once raised, the next command comes soon and is of no use
};

/// The target of the problem that stands for a record.
std::size_t target_of(const StopTasks& tasks, std::size_t record);

/// The stops of a plan. Targets that it leaves out are settled.
StopTasks tasks_of(const GuardProblem& problem, const GuardPlan& plan);

/// Takes note of what became of the last shots. A shot of which nothing is heard is a miss.
void note_shots(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                const FiringMap& firing_map);

/// The next command, or nothing when the queue is empty and no second pass is due. At most 2 `tries` shots
/// are fired at a target, so this ends.
std::optional<Command> next_command(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                                    const FiringMap& firing_map);

}  // namespace outrider
