// Safest paths: the path keeps the largest possible clearance, and is then as short and as little exposed as
// possible.
//
// Among polygons this is the question that medial_axis() answers, with the same `weight` and `kept`: its
// guarantees, its lower bound for every path of the disk, and its faults hold (medial_axis.hpp). The rest of
// this text is about grids.
//
// The clearance of a point is its distance to the nearest blocked cell (a closed square; everything outside
// the grid is blocked). On a grid made for a disk it is the tracking error that the robot can have before it
// touches. The exposure of a path is the integral of 1 / clearance along it, without unit. The planner takes
// two steps over the paths along the eight moves:
//   1. It finds the largest clearance that any of them keeps, and discards all moves with less than `kept`
//      times that clearance.
//   2. Of the remaining paths it takes the one of least cost = length + weight * exposure, m.
// At a clearance of `weight`, a metre of path costs twice its length. With weight 0 the result is the
// shortest of the widest paths.
//
// Both steps are exact. The squared clearance of vertices and of the middles of moves is an integer in half
// cells, and the least clearance of a move lies at one of its ends or its middle, so step 1 compares
// integers. The exposure of a move is computed by Simpson's rule from these three points. That is within 2.5
// % of the integral beside an obstacle and within 0.1 % at a clearance of three cells or more. Step 1 is a
// best-first search on the clearance, step 2 is A* over the moves that are wide enough; both are policies of
// search/best_first.hpp.
//
// Unless `along_moves` is set, runs of moves are then replaced by straight legs in any direction. A leg keeps
// the clearance of step 1 and costs no more than the moves that it replaces; its exposure is computed by
// Simpson's rule on max(|dx|, |dy|) equal parts. So the cost is at most the optimum along the moves.
// lower_bound is the smaller of the two: no path along the moves costs less.
//
// Complete. Accepts the model `cells`, with at most 16,383 cells per side. (In the model `corners` a path may
// run along a wall with zero clearance.) Complexity: O(n log n) for n cells; 20 bytes per cell stay in the
// workspace for the next query on the same ground. Counters and trace cover both searches. Faults: those of
// grid_query(); bad_input for another model or an option out of range; no_path; budget_exhausted; cancelled.
// Sources: widest paths, Pollack, The maximum capacity through a network (1960); the integral, Wein, van den
// Berg and Halperin, Planning high-quality paths and corridors amidst obstacles (2008).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of safest().
struct SafestOptions {
  double weight_m = 10.0;    ///< clearance at which a metre of path counts twice
  double kept = 1.0;         ///< fraction of the largest possible clearance that the path keeps
  bool along_moves = false;  ///< on grids: keep the moves instead of replacing them by straight legs
};
std::vector<Option> describe(SafestOptions& options);

/// Plans a path as described above.
Outcome<Plan> safest(const Problem& problem, const SafestOptions& options, const Budget& budget,
                     Workspace& workspace);

}  // namespace outrider
