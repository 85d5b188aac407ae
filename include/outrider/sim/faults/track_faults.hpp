// TrackFaults: what goes wrong with a robot that follows a track piece by piece (piece_body.hpp).
//
// A robot that is put elsewhere is carried for 1 s. It measures that it was, and stops. If it does not get on
// for 1 s, it gives its piece up. It has a bumper, which feels the post.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/sim/faults/way_faults.hpp"

namespace outrider {

struct TrackFaults {
  WayFaults way;
  double tracking_ratio = 1.0;  ///< true tracking error, relative to the one that was told
  double slip = 0.0;            ///< part of what the wheels roll on a piece that does not move the robot

  /// Returns true if any fault was asked for.
  [[nodiscard]] bool any() const { return way.any() || tracking_ratio != 1.0 || slip > 0.0; }
};
std::vector<Option> describe(TrackFaults& faults);

}  // namespace outrider
