// TaskBoard: the remaining stops of a guard robot and the state of each target. Behaviours (mission.hpp)
// change them by its verbs alone.
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
// while a ball that hits for sure is in the air. A target that cannot be hit from the path, or that such a
// ball missed, is shot at from the first stop to come that hits it for sure, or else from a stop at the
// shortest detour after the present one. The mission ends when the last ball has landed.
#pragma once

#include <deque>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/mission/setbacks.hpp"
#include "outrider/jobs/guard/plan/plan.hpp"
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

/// Returns what there is to say of a target that was never hit. Tries without a shot are no misses.
std::string missed(const TargetRecord& record);

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
  bool awaited = false;     ///< the command to fire it ends when it has landed
};

/// Other robots that stand somewhere, and how far the robot keeps from them.
struct KeepAway {
  std::vector<Vec2> standing;
  double gap_m = 0.0;
};

/// The remaining stops and the records of all targets. Copies are independent; problem and firing map must
/// outlive them.
class TaskBoard {
 public:
  /// Makes a board without tasks, for the first `records` targets; the robot knows these routes.
  TaskBoard(const GuardProblem& problem, const FiringMap& firing_map, std::size_t records,
            std::optional<Routes> routes = {}, bool on_the_move = false);
  /// Makes a board with the tasks of a plan. Targets that the plan leaves out get their final status.
  TaskBoard(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan);

  [[nodiscard]] const GuardProblem& problem() const { return *problem_; }
  [[nodiscard]] const FiringMap& firing_map() const { return *firing_map_; }
  [[nodiscard]] const std::vector<TargetRecord>& records() const { return records_; }
  /// Returns the target of the problem at whose place the target of a record is now.
  [[nodiscard]] std::size_t target_of(std::size_t record) const {
    return stands_at_.empty() ? record : stands_at_[record];
  }
  /// Returns the tasks to do; the first is the present one.
  [[nodiscard]] const std::deque<StopTask>& queue() const { return queue_; }
  /// Returns true if the robot is at the place of the present task.
  [[nodiscard]] bool arrived() const { return arrived_; }
  /// Returns true if something is under way that no new plan drops: an aimed gun, or a visit to a station.
  [[nodiscard]] bool is_busy() const { return aimed_ || (!queue_.empty() && queue_.front().call); }
  /// Returns true if a ball that nobody waits for is on the way to a target.
  [[nodiscard]] bool is_in_air(std::size_t record) const;
  [[nodiscard]] bool any_in_air() const { return !flying_.empty(); }
  [[nodiscard]] bool on_the_move() const { return on_the_move_; }
  [[nodiscard]] bool more_to_come() const { return more_to_come_; }
  /// Returns why nothing is tried any more; empty: it is.
  [[nodiscard]] const std::string& given_up() const { return given_up_; }
  [[nodiscard]] const CutDrives& cut() const { return cut_; }
  /// Returns the last place to which the robot was sent.
  [[nodiscard]] Vec2 last_place() const { return last_place_; }
  /// Returns the routes of the plan.
  [[nodiscard]] const std::optional<Routes>& routes() const { return routes_; }

  /// After a stop request the next command is returned soon and is meaningless.
  void set_stop(std::stop_token stop) { stop_ = std::move(stop); }
  /// Sets the budget of each search for a way.
  void set_budget(const Budget& budget) { budget_ = budget; }

  /// Updates the records with the results of the last shots. A shot without a result counts as a miss; one
  /// that nobody waits for, 5 s after the planned landing. Without `again` a miss leads to no further task.
  void note_shots(const Observation& seen, bool again = true);
  /// If the gun does not shoot (gun_silence.hpp), waits for the balls that may be in the air and then gives
  /// all waiting targets up. Returns that wait, or nothing; then given_up() says whether it gave up.
  std::optional<Command> give_up_silent_gun(const Observation& seen);
  /// Returns the next command, or nothing when the queue is empty and no second pass is due. At most 2
  /// `tries` shots are fired at a target, so the tasks always end.
  std::optional<Command> next_command(const Observation& seen);
  /// The same, but a drive that begins now leads around other robots, if it can.
  std::optional<Command> next_command_around(const Observation& seen, KeepAway others);

  /// Sets the status of a target.
  void settle(std::size_t record, TargetStatus status, std::string reason, double time_s);
  /// Fails all waiting targets and drops all tasks.
  void fail_waiting(const std::string& why, double time_s);
  /// Replaces the tasks; `arrived`: the robot is at the place of the first.
  void set_tasks(std::deque<StopTask> tasks, bool arrived = false);
  /// Puts a task before the others.
  void do_first(StopTask task);
  /// Drops the present task and returns its targets, which keep their status.
  std::vector<std::size_t> drop_task();
  /// Drops tasks at the front without targets and station.
  void drop_empty_tasks();
  /// Sets the records that may be hit during any drive, although a stop is to hit them; used on the move
  /// only.
  void set_by_the_way(std::vector<std::size_t> records) { by_the_way_ = std::move(records); }
  /// Delays the second pass, because more intruders may enter.
  void set_more_to_come(bool more) { more_to_come_ = more; }
  /// A target that was hit goes on to the place of another; all begins again for it, with the shots it has
  /// had.
  void survive(std::size_t record, std::size_t target);
  /// A drive has ended before its goal on purpose: its later shots are not fired.
  void interrupt_drive(double time_s);
  /// Notes where the last drive has ended. If that is elsewhere, its later shots are not fired, and it is
  /// driven again, unless that was tried too often. A drive may end for intruders who enter.
  void note_drive(const Observation& seen);
  /// Returns true if the robot is not where the last drive was to end.
  [[nodiscard]] bool is_elsewhere(const Observation& seen) const;
  /// Notes that the robot is sent to a place by a way of the caller.
  void begin_drive(Vec2 place);
  /// Returns the drive to a place from where the robot is, around what has held it up; nothing while it stays
  /// because drives were in vain.
  std::optional<Command> drive_again(Vec2 place, const Observation& seen);
  /// Notes a solved shot at a target from a pose.
  void aim_at(std::size_t record, const PlannedShot& shot, const Pose2& pose);
  /// Notes that a ball was fired.
  void launch(const FlyingBall& ball);
  /// The shot that was commanded last at a target is not fired.
  void take_back(std::size_t record);

 private:
  // task_board.cpp
  void drop_target();
  void note_failure(std::size_t target, const std::string& what, double time_s, bool last = false);
  void note_result(bool hit, const Observation& seen);
  void note_hit(std::size_t record, std::string_view how, double time_s);
  void look_elsewhere(const Observation& seen);
  bool leaves_out(std::size_t target, Vec2 place);
  void plan_second_pass();
  Fill fill();
  std::optional<Command> wait_for_planner(double time_s, const Fault& fault);
  std::optional<Command> set_off(const Observation& seen);
  std::optional<AimGun> take_aim(const Observation& seen);
  [[nodiscard]] bool moved_since(const Pose2& pose) const;
  Fire fire(double time_s);
  std::optional<Command> go_on_without_tasks(const Observation& seen);
  std::optional<Command> go_on_with_task(const Observation& seen);

  // setbacks.cpp: drives that end before their goal
  void take_back_unfired(double time_s, bool again);
  bool ended_elsewhere(const Observation& seen, bool again);
  void count_cut(const Observation& seen);
  void take_for_obstacle(const Pose2& here);
  void stop_for_passed();
  bool stays_here(const Observation& seen);
  AfterDrive after_drive(const Observation& seen);
  std::optional<Command> wait_if_held_up(const Observation& seen);

  // flying_balls.cpp: shots fired during drives, and what becomes of balls that nobody waits for
  /// Returns the waypoints that the robot would drive; the first place alone if there is no way. Fault:
  /// budget_exhausted.
  [[nodiscard]] Outcome<std::vector<Vec2>> way_between(const Pose2& from, Vec2 to) const;
  void take_off(std::size_t record);
  std::vector<std::size_t> wanted_in_passing();
  void note_shot(std::size_t record, const PassingHit& hit, const std::vector<Vec2>& way,
                 const Observation& seen);
  /// Returns the shots to fire during the drive along `way` to the present task: at the targets that the task
  /// has in passing, and at those by the way, which are taken off their stops. No more shots than the tank
  /// has. A target that has to be hit in passing and cannot gets a stop.
  std::vector<FireInPassing> shots_in_passing(const std::vector<Vec2>& way, const Observation& seen);
  void note_flying(const Observation& seen, bool again);
  /// Waits until the balls in the air have landed, then a little longer for results that are late. If time
  /// does not go on meanwhile, their results count as lost.
  std::optional<Wait> wait_for_balls(double time_s);

  // lost_targets.cpp: stops for targets that cannot be hit as planned, in passing or by a ball that missed
  /// Lets a target be shot at from the first of the stops to come from which it is a sure hit; without any,
  /// from a stop at the shortest detour after the present one.
  void stop_for(std::size_t record);

  const GuardProblem* problem_;
  const FiringMap* firing_map_;
  std::vector<TargetRecord> records_;   // by target
  std::vector<std::size_t> stands_at_;  // as target_of(); empty: each record is at its own target
  std::deque<StopTask> queue_;
  bool arrived_ = false;
  bool aimed_ = false;              // the gun was commanded to aim
  bool fired_ = false;              // the last command was a shot
  bool on_the_move_ = false;        // as the plan (GuardPlan)
  std::vector<FlyingBall> flying_;  // balls whose results are not known yet
  GunSilence silence_;              // the last shots without a result
  std::vector<std::size_t> by_the_way_;
  // Records that were to be shot at in passing, but had no shot then. Each has a stop, which is left out if a
  // drive before it hits the target; used on the move only.
  std::vector<std::size_t> lost_;
  std::optional<double> waited_s_;  // time at which the robot last waited for a ball in the air
  bool second_pass_ = false;        // it has begun
  std::string given_up_;
  bool more_to_come_ = false;
  Vec2 last_place_;
  std::optional<Routes> routes_;
  Budget budget_;
  std::optional<double> planless_s_;   // time since which the planner has had no budget
  CutDrives cut_;                      // drives that ended before their goal
  std::optional<KeepAway> keep_away_;  // set: the next drive leads around other robots
  std::stop_token stop_;
};

}  // namespace outrider
