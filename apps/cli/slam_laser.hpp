// `outrider slam` on a log of laser scans.
#pragma once

#include <string>

#include "outrider/io/carmen_log.hpp"
#include "outrider/slam/laser_slam.hpp"

namespace outrider::cli {

struct LaserJob {
  std::string path;
  std::string out;  ///< folder; empty for none
  bool json = false;
  LaserSlamOptions options;
};

/// Maps, says how well and how fast, and writes map, track and picture; the exit status.
int map_laser_log(const LaserJob& job, const LaserLog& log);

}  // namespace outrider::cli
