// `outrider slam` on a log of laser scans.
#pragma once

#include "outrider/io/carmen_log.hpp"
#include "slam_job.hpp"

namespace outrider::cli {

/// Maps, says how well and how fast, and writes what --out asks for; the exit status.
int map_laser_log(const SlamJob& job, const LaserLog& log);

}  // namespace outrider::cli
