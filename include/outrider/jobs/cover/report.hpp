// The report of covering an area. A pure function of its arguments.
#pragma once

#include <cstdint>
#include <string>

#include "outrider/jobs/cover/plan.hpp"
#include "outrider/jobs/cover/time_bound.hpp"
#include "outrider/report/report.hpp"
#include "outrider/sim/piece_body.hpp"

namespace outrider {

/// A track, what is known of it before it is driven, and how it was driven.
struct CoverRun {
  CoverPlan plan;
  CoverProof proof;
  TimeBound bound;
  PieceDrive drive;
  Coverage driven;  ///< by the drive, of the reach

  /// False where the drive was stopped.
  [[nodiscard]] bool finished() const { return drive.ends_s.size() == plan.track.pieces.size(); }
};

/// How much was covered by then is measured at 61 equal times (coverage_along()). The metrics are:
/// - by the drive: covered_fraction of the reach, covered_m2, missed_m2, overlap_m2, of reach_m2 and area_m2;
///   time_s, length_m, turned_rad, strayed_m;
/// - bounds: t_min_s and t_max_s on the time of any drive, order_bound_s of any order of laps and cells;
/// - of the track: planned_s at full speed, planned_m, stops (turns in place), laps, cells, lanes,
///   clearance_m (from the edges), and planned_fraction, planned_missed_m2, planned_overlap_m2 by its disk;
/// - whatever a robot does within tracking_error_m: sure_fraction of the reach, sure_inner_fraction off its
/// rim.
Report cover_report(const CoverProblem& problem, const CoverRun& run, std::uint64_t seed,
                    const std::string& name, const std::stop_token& stop = {});

}  // namespace outrider
