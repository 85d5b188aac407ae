// `outrider slam` on a log of landmarks.
#pragma once

#include "outrider/slam/landmark_log.hpp"
#include "slam_job.hpp"

namespace outrider::cli {

/// Maps, says how well, and writes what --out asks for; the exit status.
int map_landmark_log(const SlamJob& job, LandmarkLog log);

}  // namespace outrider::cli
