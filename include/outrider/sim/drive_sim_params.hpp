// DriveSimParams: what the wheels, the link and the camera of a simulated robot do wrong, and what befalls
// it.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/wheel_faults.hpp"

namespace outrider {

/// How badly a camera sees tags.
struct TagSightFaults {
  double corner_sigma_px = 0.2;  ///< of a corner, where images are not rendered
  double missed = 0.02;          ///< part of the tags in view that are not detected there
  double blind_from_s = 1e9;     ///< from then on nothing is seen
};

/// Somebody puts the robot elsewhere.
struct Kidnapping {
  double at_s = 1e9;
  double by_m = 0.8;    ///< so far to its left,
  double by_rad = 0.8;  ///< and turned by so much
};

struct DriveSimParams {
  WheelFaults wheels;
  LinkFaults link;
  TagSightFaults sight;
  Kidnapping kidnapping;
};
/// All but the link.
std::vector<Option> describe(DriveSimParams& params);

}  // namespace outrider
