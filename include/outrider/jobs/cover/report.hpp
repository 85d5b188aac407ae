// cover_report() and log_cover() tell what a coverage run came to. They are pure functions of their
// arguments.
#pragma once

#include <cstdint>
#include <string>

#include "outrider/jobs/cover/plan.hpp"
#include "outrider/jobs/cover/time_bound.hpp"
#include "outrider/log/log.hpp"
#include "outrider/report/report.hpp"
#include "outrider/sim/piece_body.hpp"

namespace outrider {

/// A track, its proofs, and its simulated drive.
struct CoverRun {
  CoverPlan plan;
  CoverProof proof;
  TimeBound bound;
  PieceDrive drive;
  Coverage driven;  ///< coverage of the reach by the drive

  /// Returns false if the drive was stopped.
  [[nodiscard]] bool finished() const { return drive.ends_s.size() == plan.track.pieces.size(); }
};

/// Logs the area, the track and the drive. The covered area is measured at 61 equal times (coverage_along()).
void log_cover(Log& log, const CoverProblem& problem, const CoverRun& run, std::uint64_t seed,
               const std::string& name, const std::stop_token& stop = {});

/// Returns the report. The metrics are:
/// - of the drive: covered_fraction of the reach, covered_m2, missed_m2, overlap_m2, of reach_m2 and area_m2;
///   time_s, length_m, turned_rad, tracking_error_m (the largest distance from the track);
/// - bounds: t_min_s and t_max_s on the time of any drive, order_bound_s of any order of laps and cells;
/// - of the track: planned_s at full speed, planned_m, stops (turns in place), laps, cells, lanes,
///   clearance_m (from the edges), and planned_fraction, planned_missed_m2, planned_overlap_m2 by its disk;
/// - for every tracking error up to tracking_error_limit_m: sure_fraction of the reach, and
/// sure_inner_fraction
///   of the reach without its rim.
Report cover_report(const CoverProblem& problem, const CoverRun& run, const std::string& name);

}  // namespace outrider
