// The turning paths that lead straight to the goal, and what manoeuvres cost. In cells.
#pragma once

#include <optional>
#include <span>

#include "outrider/motion/turning_path.hpp"
#include "steering/steering_query.hpp"

namespace outrider {

/// Returns the cost of consecutive pieces: length, and prices of cusps and of driving backwards. `direction`
/// is that of the motion before: 1 forwards, -1 backwards, 0 none.
double cost_of(const SteeringQuery& query, std::span<const TurningPiece> pieces, int direction);

/// A way to a goal that touches nothing.
struct AnalyticEnd {
  TurningPath path;
  double cost = 0.0;
};

/// The goal of a path. Without `heading_rad`, the path may end in any heading.
struct AnalyticGoal {
  Vec2 position;
  std::optional<double> heading_rad;
};

/// Returns the cheapest path to the goal among the words of Reeds and Shepp or of Dubins, or for a goal
/// without a heading among arcs with a tangent, that touches nothing and costs less than `most`.
std::optional<AnalyticEnd> analytic_end(const SteeringQuery& query, const Pose2& pose, int direction,
                                        const AnalyticGoal& goal, double most);

/// Returns motions from the start of the query with that heading, cheaper where a turning path that touches
/// nothing can stand for several of them. One pass from the start on: O(n log n) turning paths for n motions.
std::vector<TurningPiece> shortened(const SteeringQuery& query, double heading_rad,
                                    const std::vector<TurningPiece>& motions);

}  // namespace outrider
