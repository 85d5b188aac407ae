// The files of the path that a laser log gives.
#pragma once

#include <span>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/io/files.hpp"

namespace outrider {

/// A pose of the path: the number of its scan, and when that was recorded.
struct TrackedPose {
  std::size_t step = 0;
  double time_s = 0.0;
  Pose2 pose;
};

/// Returns track.csv, one line per pose: step, time (s), x, y (m), heading (rad); and trajectory.tum.
std::vector<NamedContent> track_files(std::span<const TrackedPose> track);

}  // namespace outrider
