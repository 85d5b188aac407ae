// The message of a grid without its values.
#pragma once

#include "outrider/log/messages/conversions.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Returns the message of a grid that has the values added by the caller, row by row from the origin on.
/// `yaw_rad` turns the grid about its origin; `time_s` is that of its header.
inline nav_msgs::OccupancyGrid grid_message(const GridFrame& frame, double yaw_rad, double time_s) {
  nav_msgs::OccupancyGrid grid;
  grid.header = header_of(time_s, "map");
  grid.info.resolution = static_cast<float>(frame.resolution_m);
  grid.info.width = static_cast<std::uint32_t>(frame.width);
  grid.info.height = static_cast<std::uint32_t>(frame.height);
  grid.info.origin = pose_of(Pose2{frame.origin, yaw_rad});
  return grid;
}

}  // namespace outrider
