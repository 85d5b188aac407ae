// The log of a guard mission, and its result: status, metrics and the table of targets, by capability.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "outrider/jobs/guard/run/run.hpp"
#include "outrider/log/log_queue.hpp"
#include "outrider/log/messages/gun_messages.hpp"

namespace outrider {

/// The yard as it really is.
inline const GuardProblem& true_problem(const GuardRun& run) {
  return run.truth != nullptr ? run.truth->problem : run.mission.board().problem();
}
/// Returns the intruders that the simulation lets come, survive or walk.
TargetSimParams target_params(const GuardRun& run);

/// Logs what stands still: the run, the world, the terrain, the stations, and all of it with the targets as
/// markers. Leaves out what the log has, such as that of an exploration before.
void log_yard(Log& log, const GuardProblem& problem, const GuardOptions& options, std::uint64_t seed,
              bool rigid);

/// Logs what becomes of the targets, and where they are.
class TargetLog {
 public:
  /// Logs the targets as they are at first. What is known before its time, such as when intruders come in, is
  /// put into the queue. The references must outlive this object.
  TargetLog(Log& log, LogQueue& queue, const GuardRun& run);
  /// Logs targets that stand still.
  TargetLog(Log& log, LogQueue& queue, const std::vector<Target>& targets);
  /// Logs what has changed. Call it after each step of the mission.
  void note(const GuardMission& mission, double time_s);
  /// Logs where walkers are in the end.
  void finish(const GuardMission& mission, double time_s);

 private:
  void begin(const Target& target, const Intruder* comes);
  [[nodiscard]] bool walks() const { return run_ != nullptr && run_->mission.moving() != nullptr; }
  void place(double time_s, std::size_t who, Vec2 at, Vec2 believed);
  void note_walker(const GuardMission& mission, std::size_t who);
  void note_record(const TargetRecord& record, std::size_t who, double time_s);
  /// Logs where a walker was when it was hit, or in the end.
  void place_last(double time_s, std::size_t who);

  Log& log_;
  LogQueue& queue_;
  const GuardRun* run_ = nullptr;            ///< unset if targets stand still
  std::vector<outrider_msgs::Target> told_;  ///< by target: its newest message
  std::vector<double> heights_m_;            ///< by target: of its centre
  std::vector<std::size_t> seen_;            ///< by walker: number of observations that are logged
  double noted_s_ = 0.0;                     ///< time of the last note
};

/// Returns the first store that ran empty, in a sentence; empty if none did.
std::string ran_dry(const Log& log);

/// Returns what is added to the reason of a mission that ended because no station was left; else an empty
/// text.
std::string why_stranded(const Log& log);

/// Returns the targets with their status, and the pose of the robot and the aim at the last shot.
Table target_table();
/// Returns the row of a target that was never shot at.
std::vector<TableValue> unshot_row(const std::string& name, const std::string& status,
                                   const std::string& reason, double done_s);

/// Returns the part of the targets that do not wait any more.
double settled_part(const std::vector<TargetRecord>& records);

/// Returns the report of the mission. `expected_hits` is the sum of the chances of all shots at walkers.
Report judge(const GuardRun& run, const GuardMission& mission, const SimRecord& record, const Log& log,
             double end_s, double expected_hits);

}  // namespace outrider
