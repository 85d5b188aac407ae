// SimRecord: what a simulated robot did, in the entries that a report has for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/report/report.hpp"

namespace outrider {

/// What only a robot of rigid bodies can tell.
struct RigidRecord {
  std::vector<double> arrival_errors_m =
      {};                                ///< by drive: from where the wheels were sent to where they came
  double flight_error_m = 0.0;           ///< most, from a contact to the parabola at that time
  int as_foreseen = 0;                   ///< shots that touched first what the exact flight touches
  int bumps = 0;                         ///< solids touched by the robot, counted once a drive
  std::vector<std::string> misses = {};  ///< by target: how the last shot missed; empty before
};

struct SimRecord {
  std::vector<TrackSample> track = {};
  std::vector<ReportPath> paths = {};
  std::vector<ReportShot> shots = {};
  std::vector<ReportEvent> events = {};
  std::vector<ReportLevel> levels = {};  ///< of the stores, where they are limited
  std::vector<std::vector<ReportMove>> moves =
      {};  ///< by intruder: where it was when, once it survived a hit
  std::optional<RigidRecord> rigid = {};
  double driven_m = 0.0;
  double turned_rad = 0.0;

  [[nodiscard]] double end_s() const { return track.empty() ? 0.0 : track.back().time_s; }
};

/// Swaps track, paths, shots, events and levels with those of a report: into it to show them, and back.
/// O(1).
void swap_entries(SimRecord& record, Report& report);

}  // namespace outrider
