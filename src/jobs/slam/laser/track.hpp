// The path that a laser log gives: its files, and its error.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/io/files/files.hpp"

namespace outrider {

/// A pose of the path: the number of its scan, and when that was recorded.
struct TrackedPose {
  std::size_t step = 0;
  double time_s = 0.0;
  Pose2 pose;
};

/// Returns track.csv, one line per pose: step, time (s), x, y (m), heading (rad); and trajectory.tum.
std::vector<NamedContent> track_files(std::span<const TrackedPose> track);

/// The distances of a path from a reference that was laid over it by a rigid motion of least squares. Nothing
/// if there is no reference.
struct PathError {
  std::vector<Vec2> reference;  ///< laid over the path
  std::optional<double> mean_m;
  std::optional<double> rms_m;
};

/// Compares positions, paired by index.
PathError path_error(const std::vector<Vec2>& path, const std::vector<Vec2>& reference);

}  // namespace outrider
