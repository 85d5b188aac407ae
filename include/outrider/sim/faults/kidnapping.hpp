// Kidnapping: somebody lifts a simulated robot and puts it down elsewhere.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"

namespace outrider {

struct Kidnapping {
  double at_s = 1e9;    ///< time of the kidnapping
  double by_m = 0.8;    ///< displacement to the left of the robot
  double by_rad = 0.8;  ///< change of heading
};
std::vector<Option> describe(Kidnapping& kidnapping);

}  // namespace outrider
