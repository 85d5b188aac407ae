// A scan as points of the surfaces that it saw, at even distances, each with the normal of its surface.
//
// Two beams side by side saw one surface when their ends are near each other and the line between them is not
// almost along the beams. Where such ends are far apart the line between them is filled with points, where
// they are close some are left out; a normal is square to a piece of the surface of a hand's breadth.
#pragma once

#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/laser_scan.hpp"

namespace outrider {

struct SurfacePoint {
  Vec2 position;
  Vec2 normal;  ///< towards the laser, of length 1; zero where the surface is not known
};
using Surface = std::vector<SurfacePoint>;

/// In the frame of the robot; of a scan that check() accepts, and of readings up to `reach_m`.
Surface surface_of(const LaserScan& scan, const Pose2& robot_T_laser, double reach_m);

/// At most `most` of the points, evenly chosen.
Surface thinned(const Surface& surface, std::size_t most);

}  // namespace outrider
