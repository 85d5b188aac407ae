// The safest path on a grid: as far from everything as can be, then as briefly near it as can be.
//
// The clearance of a point is its distance to the nearest blocked cell (a closed square; all is blocked
// outside the grid). On a grid made for a disk it is how far the robot may stray before it touches. The
// exposure of a path is the integral of 1 / clearance along it, without unit. Among the paths along the eight
// moves this planner takes
//   1. those whose least clearance is the largest that any of them has (or at least `kept` times that), and
//   2. of these the one of least cost = length + weight * exposure, m.
// A metre at a clearance of `weight` costs as much as two metres of nothing but length; weight 0 is the
// shortest of the widest.
//
// Both steps are exact. The clearance of vertices and of the middles of moves is known in whole numbers,
// squared, in half cells; the least of a move lies at one of these three points, so step 1 compares integers.
// The exposure of a move is Simpson's rule over the three, which is within 2.5 % of its integral beside an
// obstacle and within 0.1 % where the clearance is three cells or more. Step 1 is a best-first search on the
// clearance, step 2 is A* over the moves that are wide enough; both are policies of search/best_first.hpp.
//
// Without `along_moves` the path then becomes few waypoints: runs of moves are replaced by straight legs in
// any direction which come nowhere nearer than step 1 allows and cost no more than what they replace; a leg
// counts as Simpson's rule on max(|dx|, |dy|) equal parts. So cost is at most the optimum along the moves;
// lower_bound is the less of the two: no path along the moves costs less.
//
// Complete. Takes the model `cells`, of at most 16,383 cells a side; on `corners` a path may run along a
// wall, at no clearance. O(n log n) for n cells, and 20 bytes a cell that stay in the workspace for the next
// query on the same ground. Counters and trace are those of both searches. Faults: those of grid_query();
// bad_input on another model or an option out of range; no_path; budget_exhausted; cancelled. Sources: the
// widest path, Pollack, The maximum capacity through a network (1960); the integral, Wein, van den Berg and
// Halperin, Planning high-quality paths and corridors amidst obstacles (2008).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct SafestOptions {
  double weight_m = 10.0;
  double kept = 1.0;
  bool along_moves = false;
};
std::vector<Option> describe(SafestOptions& options);

Outcome<Plan> safest(const Problem& problem, const SafestOptions& options, const Budget& budget,
                     Workspace& workspace);

}  // namespace outrider
