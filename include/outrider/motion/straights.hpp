// Straights: the legs of a path with their times, as a robot drives them that turns in place and drives
// straight, from rest to rest (robot_model.hpp). Units: m, s, rad.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/motion/robot_model.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

/// One straight leg of a path and the time at which it is driven.
struct Straight {
  std::size_t leg = 0;  ///< index of the waypoint at which the leg ends
  Vec2 from;
  Vec2 to;
  double begin_s = 0.0;   ///< start time, counted from the beginning of the path; includes turns
  double length_s = 0.0;  ///< duration
};

/// Returns the legs of a path in order. Equal consecutive waypoints make no leg. `terrain` is null on flat
/// ground. O(waypoints).
std::vector<Straight> straights(const RobotModel& robot, double heading_rad,
                                const std::vector<Vec2>& waypoints, const HeightField* terrain = nullptr);

}  // namespace outrider
