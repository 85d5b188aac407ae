// Recorded runs to calibrate a robot from, as CSV.
//
// The head names the columns, in any order:
//     ahead_mps,left_mps,turn_dps,time_s,x_m,y_m,heading_deg
//     0.2,0,0,2.5,0.46,0.013,2.9
// One run a line: the steady command and for how long it was given, then the pose after the robot came to
// rest, as seen from where it began (x ahead, y to the left). The heading is not wrapped: two whole turns are
// 720. Empty lines are skipped, and what follows a #.
//
// Errors: bad_input with file:line. Bounds: 100,000 runs. Files may be gzip-compressed. O(length).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/control/calibrate.hpp"

namespace outrider {

Outcome<std::vector<CalibrationRun>> load_calibration_runs(const std::string& path);
Outcome<std::vector<CalibrationRun>> calibration_runs_from_text(std::string_view text,
                                                                const std::string& name);

/// Reads back to the same runs, to 6 digits after the point.
std::string calibration_runs_text(const std::vector<CalibrationRun>& runs);

}  // namespace outrider
