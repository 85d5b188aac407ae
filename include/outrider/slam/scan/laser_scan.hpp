// LaserScan: one revolution of a planar laser range finder.
#pragma once

#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// A scan.
struct LaserScan {
  double time_s = 0.0;
  double first_rad =
      0.0;  ///< bearing of the first beam in the frame of the laser, counter-clockwise from ahead
  double step_rad = 0.0;  ///< angle between consecutive beams
  double least_m = 0.0;   ///< minimum range
  double most_m = 0.0;    ///< maximum range
  /// One range per beam. From least_m to most_m: there is an obstacle at this range and none before it. Above
  /// most_m, or infinite: there is no obstacle up to most_m. Below least_m, or not a number: no reading.
  std::vector<float> ranges_m;
};

/// Checks the time, bearings, limits and number of beams (at most 1e5) of a scan. Ranges are not checked: an
/// invalid range counts as no reading.
Status check(const LaserScan& scan);

}  // namespace outrider
