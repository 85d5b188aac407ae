// LaserScan: one turn of a range finder that looks along a plane.
#pragma once

#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

struct LaserScan {
  double time_s = 0.0;
  double first_rad =
      0.0;  ///< bearing of the first beam in the frame of the laser, counter-clockwise from ahead
  double step_rad = 0.0;  ///< from each beam to the next
  double least_m = 0.0;   ///< what is nearer is not measured
  double most_m = 0.0;    ///< what is farther is not measured
  /// One a beam. From least_m to most_m: something is there, and nothing before it. More than most_m, or
  /// infinite: nothing is there up to most_m. Less than least_m, or no number: no reading.
  std::vector<float> ranges_m;
};

/// Refuses a scan whose bearings, limits or number of beams (at most 1e5) mean nothing. Ranges are never
/// refused: a bad one is no reading.
Status check(const LaserScan& scan);

}  // namespace outrider
