// CoverLog logs a coverage run while it goes on, and cover_report() returns its result, as a pure function of
// its arguments.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "outrider/jobs/cover/bounds/time_bound.hpp"
#include "outrider/jobs/cover/mission/mission.hpp"
#include "outrider/jobs/cover/mission/navigated.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/log_queue.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/report/report.hpp"
#include "outrider/sim/bodies/piece_body.hpp"

namespace outrider {

/// The end of a drive: nobody stopped it, and it covers what was promised.
struct CoverEnding {
  bool finished = true;
  bool kept = true;
};

/// A track, its proofs, and its simulated drive.
struct CoverRun {
  CoverPlan plan;
  CoverProof proof;
  TimeBound bound;
  PieceDrive drive;
  Coverage driven;                               ///< coverage of the reach by the drive
  std::optional<NavigatedCover> navigated = {};  ///< set if the navigator drove; its drive is `drive`

  /// Returns false if the drive was stopped.
  [[nodiscard]] bool finished() const {
    return navigated ? navigated->finished : drive.ends_s.size() == plan.track.pieces.size();
  }
};

/// Logs a coverage run. The covered area is measured once in a sixtieth of the time that the track takes at
/// full speed, and in the end. Thread rule: one at a time.
class CoverLog {
 public:
  /// Logs the area and the track. The log and the plan must outlive this object.
  CoverLog(Log& log, const CoverProblem& problem, const CoverPlan& plan, std::uint64_t seed,
           const std::string& name);
  /// Logs what was driven since the last call.
  void note(const PieceDrive& drive);
  /// The same of a robot that is steered: no pose changes any more.
  void note_steered(const PieceDrive& drive);
  /// Logs the end: what the drive has covered, what it missed, and what it covered more than once.
  void finish(const PieceDrive& drive, const Coverage& driven, const CoverEnding& ending = {});

 private:
  void note_drive(const PieceDrive& drive);
  void note_piece(std::size_t index, double time_s);
  void note_poses(const PieceDrive& drive, std::size_t end);
  void note_coverage(const PieceDrive& drive, double time_s);

  Log& log_;
  const CoverPlan& plan_;
  outrider_msgs::CoverageArea area_;
  bool bar_;  ///< a bar covers
  GrowingCoverage coverage_;
  LogQueue queue_;                 ///< what a piece brings, to be logged in the order of time
  std::size_t pieces_ = 0;         ///< that are logged
  std::optional<PieceRole> role_;  ///< of the last piece
  CoverageSums sums_;              ///< until measured_s_
  std::size_t poses_ = 0;          ///< that are logged
  std::size_t laps_ = 0;           ///< that have begun
  std::size_t cells_ = 0;          ///< that have begun
  double measured_s_ = -1.0;       ///< until when the coverage is measured
};

/// Returns the report. The metrics are:
/// - width_m of the robot and strip_m, the width of what it covers;
/// - of the drive: covered_fraction of the reach, covered_m2, missed_m2, overlap_m2, of reach_m2 and area_m2;
///   time_s, length_m, turned_rad, tracking_error_m (the largest distance from the track);
/// - bounds: t_min_s and t_max_s on the time of any drive, order_bound_s of any order of laps and cells;
/// - areas_apart, the number of areas that do not touch, and transfer_m, the length of the drives between
/// them;
/// - of the track: planned_s at full speed, planned_m, length_bound_m (of any track), stops (turns in place),
/// laps, cells, lanes,
///   clearance_m (from the edges), and planned_fraction, planned_missed_m2, planned_overlap_m2 by its disk;
/// - for every tracking error up to tracking_error_limit_m: sure_fraction of the reach, and
/// sure_inner_fraction
///   of the reach without its rim;
/// - with the navigator: reachable_m2 and reachable_fraction (what a robot can cover that keeps its room from
///   what truly stands there, and the covered part of that), left_m2 (that the robot knows of), rounds (of
///   planning what was left), recoveries, contacts, walked_into (people who walked into it), left_ground (how
///   often it came out of the area), blocked_s (when a post was put in its way; -1 if none was), and
///   false_covered: the robot believes that all is covered, and it is not.
Report cover_report(const CoverProblem& problem, const CoverRun& run, const std::string& name);

}  // namespace outrider
