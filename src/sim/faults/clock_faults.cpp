#include "outrider/sim/faults/clock_faults.hpp"

namespace outrider {

std::vector<Option> describe(ClockFaults& faults) {
  return {
      {"clock_jumps_at", "s", 0.0, 1e9, "when the robot's clock jumps", &faults.jumps_at_s},
      {"clock_jumps_by", "s", -1e6, 1e6, "how far, forwards if positive", &faults.jumps_by_s},
  };
}

}  // namespace outrider
