#include "steering_plan.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"
#include "steering/motions/turning_pieces.hpp"

namespace outrider {
namespace {

constexpr double arc_step_rad = radians(5.0);  // between waypoints

}  // namespace

std::vector<PathPiece> pieces_along(Pose2 pose, const std::vector<TurningPiece>& motions, double radius_m) {
  std::vector<PathPiece> pieces;
  for (const TurningPiece& part : joined(motions, radius_m)) {
    pieces.push_back(piece_of(pose, part, radius_m));
    pose = after(pose, part, radius_m);
  }
  return pieces;
}

Plan steering_plan(const Problem& problem, const SteeringOptions& options, Vec2 start,
                   const std::vector<PathPiece>& pieces, double lower_bound, const PlanCounters& counters) {
  Plan plan;
  plan.counters = counters;
  plan.steering = steering_of(options);
  plan.weights = weights_of(options);
  plan.pieces = pieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const PathPiece& piece = pieces[i];
    const double per_m = plan.weights.per_m + (piece.backward ? plan.weights.per_backward_m : 0.0);
    const bool cusp = i > 0 && pieces[i - 1].backward != piece.backward;
    plan.cost += per_m * length_of(piece) + (cusp ? plan.weights.per_cusp : 0.0);
    if (piece.turn_rad == 0.0) continue;
    const double sagitta_m = distance(piece.centre, piece.from) * (1.0 - std::cos(0.5 * arc_step_rad));
    plan.waypoint_error_m = std::max(plan.waypoint_error_m, sagitta_m);
  }
  plan.waypoints = points_along(start, plan.pieces, arc_step_rad);
  plan.lower_bound = std::min(lower_bound, plan.cost);
  plan.reached_within = distance(plan.waypoints.back(), problem.goal);
  return plan;
}

}  // namespace outrider
