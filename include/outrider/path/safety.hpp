// How safe a plan is: how near it comes to anything, and for how long. Shares nothing with the planners.
//
// The clearance of a point is its distance to the nearest edge of polygons, the radius of the robot counted
// in; on a grid to the nearest blocked cell (closed squares, all of them outside the grid), so beyond the
// radius that its cells were grown by. The exposure of a path is the integral of 1 / clearance along it,
// without unit: it grows by ln 2 on a straight way to a wall for each halving of the distance.
//
// The least clearance is exact. The exposure is summed over pieces of length 2 h about points of clearance c,
// with h at most c / 64, as 2 h / c; clearance changes by no more than one moves, so the truth lies between
// 2 ln(1 + h / c) and -2 ln(1 - h / c), and the sums of these are proven bounds, within 0.8 % of each other's
// middle. On a grid of corners a path may touch walls: its exposure is infinite then. O(exposure) clearances,
// each O(clearance^2) cells of a grid or O(n) for n edges.
#pragma once

#include "outrider/path/plan.hpp"

namespace outrider {

struct Safety {
  double clearance_m = 0.0;    ///< the least along the path
  double exposure = 0.0;       ///< good to 0.1 % as a rule
  double exposure_low = 0.0;   ///< proven
  double exposure_high = 0.0;  ///< proven
};

/// Of the pieces of the plan, or of its waypoints where it has none, on the ground of the problem.
Safety safety_of(const Plan& plan, const Problem& problem);

}  // namespace outrider
