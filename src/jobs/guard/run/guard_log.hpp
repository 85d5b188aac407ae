// The log of a guard mission, and its result: status, metrics and the table of targets, by capability.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/jobs/guard/mission/mission_log.hpp"
#include "outrider/jobs/guard/run/run.hpp"

namespace outrider {

/// The yard as it really is.
inline const GuardProblem& true_problem(const GuardRun& run) {
  return run.truth != nullptr ? run.truth->problem : run.guard.mission->board().problem();
}

/// Logs what stands still: the run, the world, the terrain, the stations, and all of it with the targets as
/// markers. Leaves out what the log has, such as that of an exploration before.
void log_yard(Log& log, const GuardProblem& problem, const GuardScenario& scenario);

/// Log from where targets can be hit, at `time_s`: one grid for each target, or one for all. O(cells *
/// targets).
void log_firing_regions(Log& log, const GuardProblem& problem, const FiringMap& firing_map,
                        double time_s = 0.0);
void log_firing_map(Log& log, const FiringMap& firing_map, double time_s = 0.0);
/// Logs for each target that cannot be hit the flight that comes nearest to a hit.
void log_blocked_flights(Log& log, const GuardProblem& problem, const FiringMap& firing_map,
                         double time_s = 0.0);
/// Logs a tour.
void log_tour(Log& log, const GuardProblem& problem, const TourDraft& tour, double time_s = 0.0);

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

using Metrics = std::vector<std::pair<std::string, double>>;

/// A mission that is over, of one robot or several.
struct EndedMission {
  const GuardProblem& problem;  ///< the yard as it really is
  const std::vector<TargetRecord>& records;
  const SimRecord& record;  ///< the sum of all robots
  const Log& log;
  double end_s = 0.0;
  bool on_the_move = false;
  bool has_faults = false;
  const TaskBoard* board = nullptr;  ///< of the robot, if there is one
};

/// The form of the reason where not all were reached, for the numbers of those reached, all, failed and
/// without a shot.
inline constexpr std::string_view targets_missed = "{} of {} targets reached, {} failed, no shot found at {}";

/// Returns the metrics of missions against targets that stand still.
Metrics tour_metrics(const GuardPlan& plan, const EndedMission& ended);

/// Returns the report: what all missions have, with the metrics of what is `known` of the targets.
Report judge(const EndedMission& ended, const Metrics& known, std::string_view missed_form = targets_missed);
/// Returns the report of the mission of one robot.
Report judge(const GuardRun& run, const GuardMission& mission, const SimRecord& record, const Log& log,
             double end_s);

/// Returns a guarded yard in words for people, from its metrics and tables.
std::string guard_summary(const Report& report);

}  // namespace outrider
