// The catch of least total cost, with a proof (lower_bound = cost), and the earliest possible catch.
//
// Complete and optimal, in integers. The search stops as soon as the proof is complete:
//   0. In each second the robot is in a box: it can have come there, and can still come to the target. If the
//      boxes of all seconds hold at most 24 times the cells of the map, of which there are 4096 or more, and
//      2^24, dynamic programming sweeps them from the start on, with 4 bytes for each cell of a box, and that
//      is all.
//   1. A flood of steps from the robot finds the earliest catch, a first path, and the cells that matter. Now
//      the work of stage 5 is known; if it is little, stage 5 follows at once.
//   2. Dijkstra floods from the target ignore the clock but put a price on each second. Each yields a lower
//      bound of the cost of any catch from any cell and second, and a candidate path. The price of a second
//      is the Lagrange multiplier of the constraint that a path has no more steps than seconds; it is chosen
//      to maximise the bound.
//   3. One such flood from the robot bounds the way to each cell. Together they show the best path that waits
//      in one cell. Sweeps over the cells near the best path in each second improve it.
//   4. A* expands labels (cost, seconds, cheapest cell so far). Labels contain no waiting, because all
//      waiting can be done in the cheapest cell of a path. A label dominates a later one if it is no dearer
//      after waiting until then and its cheapest cell is no dearer.
//   5. Dynamic programming sweeps the cells that the bounds leave, from the last second back to the first,
//      16 or 32 bytes of a row at once, with the same results on every processor. It counts what paths cost
//      above the least that each second costs anyhow, in 16 bits if that is enough. On the way it improves
//      the end of the best path.
// The work of stages 2 to 4 is limited to a part of that of stage 5, so the whole takes hardly longer than
// the plain dynamic programme. A flood takes O(cells log(largest cost)), stage 5 O(cells seconds). Memory: 13
// bytes per cell for each of 13 bounds at worst, 50 more per cell, 40 per label, and about (cells
// seconds^3)^(1/4) cells of stage 5. Sources: Handler and Zang, A dual algorithm for the constrained shortest
// path problem (1980); Desrochers and Soumis, A generalized permanent labelling algorithm for the shortest
// path problem with time windows (1988).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/pursuit/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The planner has no options.
struct OptimalPursuitOptions {};
std::vector<Option> describe(OptimalPursuitOptions& options);

/// Plans the cheapest catch. Faults: those of check(problem); no_path with the reason of why_no_catch();
/// budget_exhausted; cancelled.
Outcome<PursuitPlan> optimal_pursuit(const PursuitProblem& problem, const OptimalPursuitOptions& options,
                                     const Budget& budget, Workspace& workspace);

}  // namespace outrider
