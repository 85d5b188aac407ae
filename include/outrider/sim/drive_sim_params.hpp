// DriveSimParams: faults of the wheels, the radio link and the camera of a simulated robot, and a kidnapping.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/wheel_faults.hpp"

namespace outrider {

/// Faults of a tag camera.
struct TagSightFaults {
  double corner_sigma_px = 0.2;  ///< standard deviation of a detected corner; used without rendered images
  double missed = 0.02;          ///< fraction of visible tags not detected; used without rendered images
  double blind_from_s = 1e9;     ///< time at which the camera fails; it sees nothing afterwards
};

/// A tag that hangs elsewhere than the map says.
struct MovedTag {
  std::int64_t id = -1;  ///< of the tag; -1: none
  double by_m = 0.3;     ///< to the right of a reader of the tag
};

/// A kidnapping: somebody lifts the robot and puts it down elsewhere.
struct Kidnapping {
  double at_s = 1e9;    ///< time of the kidnapping
  double by_m = 0.8;    ///< displacement to the left of the robot
  double by_rad = 0.8;  ///< change of heading
};

/// What goes wrong while a simulated robot drives.
struct DriveSimParams {
  WheelFaults wheels;     ///< errors between commanded and true wheel speeds
  LinkFaults link;        ///< faults of the link that carries the commands
  TagSightFaults sight;   ///< faults of the camera
  Kidnapping kidnapping;  ///< none by default
  MovedTag moved_tag;     ///< none by default
};
/// Returns the options of all members except the link.
std::vector<Option> describe(DriveSimParams& params);

}  // namespace outrider
