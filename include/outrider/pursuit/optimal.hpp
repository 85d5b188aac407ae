// The catch of least total cost, with a proof (lower_bound = cost), and the earliest possible catch.
//
// Complete and optimal, in integers. The search has four stages and stops as soon as the proof is complete:
//   1. A flood of steps from the robot finds the earliest catch, a first path, and the cells that matter.
//   2. Dijkstra floods from the target ignore the clock but put a price on each second. Each yields a lower
//      bound of the cost of any catch from any cell and second, and a candidate path. The price of a second
//      is the Lagrange multiplier of the constraint that a path has no more steps than seconds; it is chosen
//      to maximise the bound.
//   3. A* expands labels (cost, seconds, cheapest cell so far). Labels contain no waiting, because all
//      waiting can be done in the cheapest cell of a path. A label dominates a later one if it is no dearer
//      after waiting until then and its cheapest cell is no dearer.
//   4. If there are too many labels, a search second by second covers the cells that the bounds leave.
// Stages 1 and 2 take O(cells log(largest cost)) per flood, with at most 13 floods; stage 4 never takes more
// than the sweep of every cell in every second. Memory: 13 bytes per cell for each of 13 bounds at worst, 20
// more per cell, 40 per label, and about sqrt(seconds) layers of stage 4.
// Sources: Handler and Zang, A dual algorithm for the constrained shortest path problem (1980); Desrochers
// and Soumis, A generalized permanent labelling algorithm for the shortest path problem with time windows
// (1988).
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
