// The safety of a plan: its clearance from obstacles and its exposure to them. Shares no code with the
// planners.
//
// On polygons, the clearance of a point is its distance to the nearest edge, including the radius of the
// robot. On a grid, it is the distance to the nearest blocked cell (a closed square; everything outside the
// grid is blocked), excluding the radius by which obstacles were grown. The exposure of a path is the
// integral of 1 / clearance along it, a number without unit. On a straight path towards a wall it grows by ln
// 2 each time the distance halves.
//
// The least clearance is exact. The exposure is a sum over path pieces of length 2 h, each 2 h / c, where c
// is the clearance at the middle of the piece and h <= c / 64. Clearance changes by at most the distance
// moved, so the true value of a piece lies between 2 ln(1 + h / c) and -2 ln(1 - h / c). The sums of these
// are proven bounds, within 0.8 % of their mean. On a grid of corners a path may touch walls; its exposure is
// infinite then. Complexity: O(exposure) clearances, each O(clearance^2) cells of a grid or O(n) for n edges.
#pragma once

#include <stop_token>

#include "outrider/path/plan.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Clearance and exposure of a path.
struct Safety {
  double clearance_m = 0.0;    ///< least clearance along the path
  double exposure = 0.0;       ///< estimate, usually accurate to 0.1 %
  double exposure_low = 0.0;   ///< proven lower bound
  double exposure_high = 0.0;  ///< proven upper bound
};

/// Returns the least distance of a robot with that outline (as in Problem) to the blocked cells of a grid,
/// exactly, at most `most_m`; of a disk that of its centre.
double clearance_m(const Plan& plan, const GridMap& ground, const std::vector<Vec2>& outline, double most_m);
/// Returns it to the exact shapes of a world and its bounds, to hulls_error_m(); 0 or less where it overlaps
/// one. O(obstacles) for each hull (pieces.hpp).
double clearance_m(const Plan& plan, const CollisionMap& ground, const std::vector<Vec2>& outline);

/// Computes the safety of the pieces of the plan, or of the legs between its waypoints if it has no pieces.
Safety safety_of(const Plan& plan, const Problem& problem, const std::stop_token& stop = {});

}  // namespace outrider
