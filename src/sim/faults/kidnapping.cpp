#include "outrider/sim/faults/kidnapping.hpp"

namespace outrider {

std::vector<Option> describe(Kidnapping& kidnapping) {
  return {
      {"kidnapped_at", "s", 0.0, 1e9, "when the robot is put elsewhere", &kidnapping.at_s},
      {"kidnapped_by", "m", -100.0, 100.0, "how far to its left", &kidnapping.by_m},
      {"kidnapped_turn", "deg", -180.0, 180.0, "and turned by how much", &kidnapping.by_rad},
  };
}

}  // namespace outrider
