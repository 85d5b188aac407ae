// SimRecord: the actions of a simulated robot, as entries of a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/report/report.hpp"

namespace outrider {

/// Additional measurements of a robot simulated with rigid bodies.
struct RigidRecord {
  /// For each drive, the distance between the goal sent to the wheels and the place reached.
  std::vector<double> arrival_errors_m = {};
  double flight_error_m = 0.0;           ///< largest distance from a contact to the parabola at that time
  int as_foreseen = 0;                   ///< number of shots whose first contact agrees with the exact flight
  int bumps = 0;                         ///< solids touched by the robot, each counted once per drive
  std::vector<std::string> misses = {};  ///< by target: how the last shot missed; empty before the first miss
};

/// What a simulated robot has done so far.
struct SimRecord {
  std::vector<TrackSample> track = {};
  std::vector<ReportPath> paths = {};
  std::vector<ReportShot> shots = {};
  std::vector<ReportEvent> events = {};
  std::vector<ReportLevel> levels = {};  ///< levels of the stores, if they are limited
  /// By intruder: its movements after it survived a hit.
  std::vector<std::vector<ReportMove>> moves = {};
  std::optional<RigidRecord> rigid = {};  ///< set if rigid bodies are simulated
  double driven_m = 0.0;
  double turned_rad = 0.0;

  [[nodiscard]] double end_s() const { return track.empty() ? 0.0 : track.back().time_s; }
};

/// Swaps track, paths, shots, events and levels with those of a report. Call it once to show the record in
/// the report, and again to take it back. O(1).
void swap_entries(SimRecord& record, Report& report);

}  // namespace outrider
