// Recorded logs of robots that look for landmarks, in the formats of published data.
//
//   freiburg   lines "ODOMETRY turn distance turn" and "SENSOR id range bearing" (m, rad); the map "id x y"
//   mrclam     UTIAS MR.CLAM: lines of time, forward and turning speed; of time, barcode, range and bearing;
//              of subject and barcode; of subject, x, y and two deviations. '#' starts a comment. Other
//              robots are no landmarks and are left out.
//   chain      lines "ODOMETRY i j x y heading" and "LANDMARK i k x y", each with the upper triangle of its
//              covariance; a LANDMARK stands after the ODOMETRY that leads to its pose
//
// The noise of logs that do not give one is that of LogNoise. Errors: bad_input with file:line, what is wrong
// and what would be right. Bounds: 2,000,000 lines.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/landmark_log.hpp"

namespace outrider {

/// Standard deviations. Those of odometry grow with the root of what was driven and turned.
struct LogNoise {
  double distance = 0.01;
  double turn_per_distance_rad = radians(6.0);
  double turn = 0.1;
  double range_m = 0.3;
  double bearing_rad = radians(6.0);
};

std::vector<Option> describe(LogNoise& noise);

/// Text and the name under which it is spoken of.
struct NamedText {
  std::string_view text;
  std::string name;
};

/// `map` may be empty.
Outcome<LandmarkLog> landmark_log_from_freiburg(const NamedText& log, const NamedText& map,
                                                const LogNoise& noise);

struct MrclamTexts {
  NamedText odometry;
  NamedText measurements;
  NamedText barcodes;
  NamedText landmarks;  ///< may be empty
};
/// A step for each time at which landmarks were sighted.
Outcome<LandmarkLog> landmark_log_from_mrclam(const MrclamTexts& texts, const LogNoise& noise);

Outcome<LandmarkLog> landmark_log_from_chain(const NamedText& log);

}  // namespace outrider
