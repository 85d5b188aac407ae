// Recorded runs for the calibration of a robot, as CSV.
//
// The header line names the columns, in any order:
//     ahead_mps,left_mps,turn_dps,time_s,x_m,y_m,heading_deg
//     0.2,0,0,2.5,0.46,0.013,2.9
// Each further line is one run: the constant command and its duration, then the pose after the robot came to
// rest, relative to the pose at the beginning (x ahead, y to the left). The heading is not wrapped: two whole
// turns are 720. Empty lines are skipped; # starts a comment.
//
// Faults: bad_input with file:line. Bounds: 100,000 runs. Files may be gzip-compressed. O(length).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/control/calibrate.hpp"

namespace outrider {

Outcome<std::vector<CalibrationRun>> load_calibration_runs(const std::string& path);
Outcome<std::vector<CalibrationRun>> calibration_runs_from_text(std::string_view text,
                                                                const std::string& name);

/// Returns the runs as CSV: commands and times with 6 significant digits, poses with 6 digits after the
/// point.
std::string calibration_runs_text(const std::vector<CalibrationRun>& runs);

}  // namespace outrider
