// Function that logs what stands still once more as plain markers, which every viewer of ROS logs draws.
#pragma once

#include <string>
#include <vector>

#include "outrider/geometry/vec.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

/// A box with a name, such as a target.
struct MarkerBox {
  std::string name;
  Vec3 centre;
  double yaw_rad = 0.0;
  Vec3 size;  ///< length, width and height, m
};

/// Logs the solids, the terrain, the walls, the zones, the area to cover, the tags and the stations that the
/// log has, and `targets`, as markers at time 0. A solid is a prism over its footprint; one without end is 1
/// m high; large terrain is coarser. Logs nothing if there is nothing of that. O(their corners).
void log_markers(Log& log, const std::vector<MarkerBox>& targets = {});

}  // namespace outrider
