// ClockFaults: the clock of a robot that jumps. All times that the robot measures or is given are those of
// that clock.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"

namespace outrider {

struct ClockFaults {
  double jumps_at_s = 1e9;  ///< time of the jump
  double jumps_by_s = 5.0;  ///< how far, forwards if positive

  /// Returns what the clock shows too much at a time, s.
  [[nodiscard]] double ahead_s(double time_s) const { return time_s < jumps_at_s ? 0.0 : jumps_by_s; }
};
std::vector<Option> describe(ClockFaults& faults);

}  // namespace outrider
