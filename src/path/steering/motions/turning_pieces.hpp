// Turning paths as pieces of a plan.
#pragma once

#include <vector>

#include "outrider/motion/turning_path.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

/// Pieces that are shorter are none, radii.
inline constexpr double no_length = 1e-9;

/// Returns an arc or a straight piece that begins at the pose.
PathPiece piece_of(const Pose2& from, const TurningPiece& part, double radius_m);

/// Joins consecutive pieces of the same arc or line that are driven in the same direction. Leaves out those
/// without a length.
std::vector<TurningPiece> joined(const std::vector<TurningPiece>& parts, double radius_m);

}  // namespace outrider
