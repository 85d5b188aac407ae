// Reasons to doubt the map of an exploration.
//
// A robot that was carried away goes on mapping where odometry puts it. If it is recognised later, the map is
// right; if it is not, parts of the map lie beside or over each other, and neither the map nor the pose of
// the robot can be believed. So the robot asks, before it calls its map complete, what the map of `slam` is
// asked: is there a gap that odometry alone joins, or a jump that neither odometry nor scans confirm, and do
// the scans agree on what is free (slam/map/map_check.hpp)? A range finder that is off, or whose beams end
// anywhere, makes a wrong map too (slam/map/range_check.hpp).
#pragma once

#include <string>

#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {

/// Returns why the map cannot be believed because of the range finder; empty if it can. O(keyframes).
std::string range_finder_doubt(const LaserSlam& slam);

/// Returns why the map, and so the pose of the robot, cannot be believed; empty if it can.
/// O(keyframes^2 + keyframes beams).
std::string map_doubt(const LaserSlam& slam);

}  // namespace outrider
