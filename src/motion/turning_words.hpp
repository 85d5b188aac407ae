// What the two families of turning paths share: the question with a radius of 1 and the start at the origin.
#pragma once

#include "outrider/motion/turning_path.hpp"

namespace outrider::turning {

/// Returns the pose `to` in the frame of `from`, lengths in radii.
Pose2 normalised(const Pose2& from, const Pose2& to, double radius_m);

/// Returns those of the paths that end at the goal, shortest first, scaled to the radius. Pieces of no length
/// are left out.
std::vector<TurningPath> arriving(const std::vector<TurningPath>& paths, const Pose2& goal, double radius_m);

}  // namespace outrider::turning
