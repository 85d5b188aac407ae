#include "outrider/sim/faults/track_faults.hpp"

namespace outrider {

std::vector<Option> describe(TrackFaults& faults) {
  std::vector<Option> options = describe(faults.way);
  options.push_back({"tracking", "", 0.0, 100.0, "true tracking error, relative to tracking_error",
                     &faults.tracking_ratio});
  options.push_back({"slip", "", 0.0, 0.9,
                     "part of what the wheels roll on a leg or arc that does not move the robot, which ends "
                     "short by it",
                     &faults.slip});
  return options;
}

}  // namespace outrider
