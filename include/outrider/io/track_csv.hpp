// Writes the poses of a track as a table.
#pragma once

#include <string>
#include <vector>

#include "outrider/geometry/pose.hpp"

namespace outrider {

/// Returns one line per pose: number, x, y, heading (m, rad).
std::string track_csv(const std::vector<Pose2>& poses);

}  // namespace outrider
