// A scan as evenly spaced points on the surfaces that it hit, each with a surface normal.
//
// The ends of two neighbouring beams belong to one surface if they are close together and the line between
// them is not nearly parallel to the beams. Points are interpolated where such ends are far apart, and
// dropped where they are dense. A normal is perpendicular to about 12 cm of surface to each side.
#pragma once

#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

struct SurfacePoint {
  Vec2 position;
  Vec2 normal;  ///< unit length, towards the laser; zero if unknown
};
using Surface = std::vector<SurfacePoint>;

/// Returns the points in the frame of the robot. Uses readings up to `reach_m`; check() must accept the scan.
Surface surface_of(const LaserScan& scan, const Pose2& robot_T_laser, double reach_m);

/// Returns at most `most` of the points, evenly chosen.
Surface thinned(const Surface& surface, std::size_t most);

}  // namespace outrider
