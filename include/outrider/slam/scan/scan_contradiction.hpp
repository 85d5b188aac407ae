// Do two scans of one place contradict each other?
#pragma once

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

/// Returns the share of the points that both scans can see and one of them looked through; 0 if there are
/// fewer than 40 of them. A point may be off by 0.15 m and 0.02 rad. Poses are world_T_laser. Expects scans
/// that check() accepts. O(beams of both).
double contradiction(const LaserScan& a, const Pose2& world_T_a, const LaserScan& b, const Pose2& world_T_b);

}  // namespace outrider
