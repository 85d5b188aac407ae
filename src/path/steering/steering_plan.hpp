// A plan of a robot that steers, from its motions.
#pragma once

#include <vector>

#include "outrider/motion/turning_path.hpp"
#include "outrider/path/steering/steering_options.hpp"

namespace outrider {

/// Returns motions that begin at the pose as pieces; of motions along the same arc or line one.
std::vector<PathPiece> pieces_along(Pose2 pose, const std::vector<TurningPiece>& motions, double radius_m);

/// Makes a plan that begins at `start`. Its cost comes from its pieces, m; `lower_bound` may exceed it by
/// rounding.
Plan steering_plan(const Problem& problem, const SteeringOptions& options, Vec2 start,
                   const std::vector<PathPiece>& pieces, double lower_bound, const PlanCounters& counters);

}  // namespace outrider
