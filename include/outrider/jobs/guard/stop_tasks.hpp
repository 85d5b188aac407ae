// StopTasks: the remaining stops of a guard robot and the state of each target.
//
// At each stop the shot is solved again from the pose actually reached; the search prefers the soonest shot
// and counts pitch motion from the planned pitch. Without errors the result is the planned shot. A target
// that is missed `tries` times has failed. When all stops are done, there is a second pass: each failed
// target is tried again from another place, and each target without a firing region is tried again without
// the clearance margin.
//
// A target that was missed is given up sooner if a hit would take more than `give_up_s` on average: the
// flight divided by the hit rate of the shot, plus, in the second pass, the straight drive divided by the
// probability of at least one hit in `tries` shots.
//
// Shots in passing (passing.hpp) are solved again for the actual path when the drive begins. If the plan is
// made on the move, the gun turns to the first shot of a stop during the drive there, and the robot goes on
// while a ball that hits for sure is in the air. A target that cannot be hit from the path is shot at from
// the first stop to come that hits it for sure, or else before the drive if that hits it for sure, or else
// from a stop at the shortest detour, before the present one only if that takes no planned shot away; so is
// one that such a ball missed, but not before a drive. The mission ends when the last ball has landed.
#pragma once

#include <deque>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/cut_drives.hpp"
#include "outrider/jobs/guard/gun_silence.hpp"
#include "outrider/jobs/guard/plan.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider {

enum class TargetStatus { waiting, reached, failed, unreachable };
std::string_view to_string(TargetStatus status);

/// The state of one target.
struct TargetRecord {
  TargetStatus status = TargetStatus::waiting;
  std::string reason;               ///< one sentence that explains the status
  int shots = 0;                    ///< number of shots fired at it
  std::int64_t tries = 0;           ///< misses and places without a shot in the present pass
  std::optional<PlannedShot> shot;  ///< the shot that was solved last
  Pose2 pose;                       ///< pose of the robot at the last attempt to solve a shot
  double done_s = 0.0;              ///< time of the last change of the status
  int unanswered = 0;               ///< shots of which the robot reported no result
};

/// Sets the final status of a target.
void settle(TargetRecord& record, TargetStatus status, std::string reason, double time_s);

/// A stop to make: a place, and the targets to shoot at or the store to fill there.
struct StopTask {
  Vec2 place;
  std::vector<std::size_t> targets = {};  ///< targets to shoot at from the place, in order
  std::optional<StationCall> call = {};   ///< set if a store is filled here
  std::vector<std::size_t> passing = {};  ///< targets to shoot at during the drive there
  std::vector<GunAngles> guns = {};       ///< planned aim for each target; empty: none planned
};

/// A ball in the air that nobody waits for.
struct FlyingBall {
  std::size_t target = 0;
  double lands_s = 0.0;     ///< as planned
  bool in_passing = false;  ///< fired during a drive
  double leaves_s = 0.0;    ///< when it is fired, as planned
  bool unsure = false;      ///< the drive was cut about then: it may not have been fired
};

/// Other robots that stand somewhere, and how far the robot keeps from them.
struct KeepAway {
  std::vector<Vec2> standing;
  double gap_m = 0.0;
};

/// The remaining stops and the records of all targets.
struct StopTasks {
  std::vector<TargetRecord> records;    ///< by target
  std::deque<StopTask> queue;           ///< tasks to do; the first is the present one
  bool arrived = false;                 ///< the robot is at the place of the present task
  bool aimed = false;                   ///< the gun was commanded to aim
  bool fired = false;                   ///< the last command was a shot
  bool on_the_move = false;             ///< as the plan (GuardPlan)
  std::vector<FlyingBall> flying = {};  ///< balls whose results are not known yet
  GunSilence silence = {};              ///< the last shots without a result
  /// Records that may be hit during any drive, although a stop is to hit them; used on the move only.
  std::vector<std::size_t> by_the_way = {};
  /// Records that were to be shot at in passing, but had no shot then. Each has a stop, which is left out if
  /// a drive before it hits the target; used on the move only.
  std::vector<std::size_t> lost = {};
  std::optional<double> waited_s = {};  ///< time at which the robot last waited for such a ball
  bool second_pass = false;             ///< the second pass has begun
  std::string given_up = {};            ///< why nothing is tried any more; empty: it is
  bool more_to_come = false;            ///< delays the second pass, because more intruders may enter
  Vec2 last_place;                      ///< last place to which the robot was sent
  /// By record: the target of the problem at whose place it is now. Empty: each record is at its own target.
  std::vector<std::size_t> stands_at;
  std::optional<Routes> routes;            ///< routes of the plan
  Budget budget = {};                      ///< of the planner at present
  std::optional<double> planless_s = {};   ///< time since which the planner has had no budget
  CutDrives cut = {};                      ///< drives that ended before their goal
  std::optional<KeepAway> keep_away = {};  ///< set: the next drive leads around other robots, if it can
  std::stop_token stop = {};  ///< after a stop request, the next command is returned soon and is meaningless
};

/// Returns the target of the problem at whose place the target of a record is now.
std::size_t target_of(const StopTasks& tasks, std::size_t record);

/// Makes the tasks of a plan. Targets that the plan leaves out get their final status.
StopTasks tasks_of(const GuardProblem& problem, const GuardPlan& plan);

/// Updates the records with the results of the last shots. A shot without a result counts as a miss; one that
/// nobody waits for, 5 s after the planned landing.
void note_shots(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                const FiringMap& firing_map);

/// If the gun does not shoot (gun_silence.hpp), waits for the balls that may be in the air and then gives all
/// waiting targets up. Returns that wait, or nothing; then `tasks.given_up` says whether it gave up.
std::optional<Command> give_up_silent_gun(StopTasks& tasks, const Observation& seen);

/// Returns the next command, or nothing when the queue is empty and no second pass is due. At most 2 `tries`
/// shots are fired at a target, so the tasks always end.
std::optional<Command> next_command(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                                    const FiringMap& firing_map);

}  // namespace outrider
