// Recorded logs of robots that observe landmarks, in the formats of published data.
//
//   freiburg   lines "ODOMETRY turn distance turn" and "SENSOR id range bearing" (m, rad); the map "id x y"
//   mrclam     UTIAS MR.CLAM, four files: lines of time, forward and turning speed; of time, barcode, range
//              and bearing; of subject and barcode; of subject, x, y and two standard deviations. '#' starts
//              a comment. Other robots are not landmarks and are skipped.
//   chain      lines "ODOMETRY i j x y heading" and "LANDMARK i k x y", each with the upper triangle of its
//              covariance; a LANDMARK line follows the ODOMETRY line that leads to its pose
//
// For logs without noise, LogNoise gives it. Faults: bad_input with file:line, the error and the remedy.
// Bounds: 2,000,000 lines.
#pragma once

#include <string>
#include <string_view>

#include "outrider/slam/landmark/landmark_log.hpp"

namespace outrider {

/// A text and its name in faults.
struct NamedText {
  std::string_view text;
  std::string name;
};

/// Reads a freiburg log. `map` may be empty.
Outcome<LandmarkLog> landmark_log_from_freiburg(const NamedText& log, const NamedText& map,
                                                const LogNoise& noise);

struct MrclamTexts {
  NamedText odometry;
  NamedText measurements;
  NamedText barcodes;
  NamedText landmarks;  ///< may be empty
};
/// Reads an mrclam log. There is one step for each time at which landmarks were sighted.
Outcome<LandmarkLog> landmark_log_from_mrclam(const MrclamTexts& texts, const LogNoise& noise);

/// Reads a chain log.
Outcome<LandmarkLog> landmark_log_from_chain(const NamedText& log);

}  // namespace outrider
