// The catch of least total cost, with its proof: lower_bound = cost, and the earliest catch there is.
//
// Complete and optimal, in whole numbers. In turn, and only as far as the proof needs:
//   1. A flood of steps from the robot: the earliest catch, a first way, the cells that matter.
//   2. Dijkstra floods from the target that forget the clock but price it: each bounds what any catch
//      costs from any cell and second on, and proposes a way. The price of a second is the multiplier
//      of the constraint that a way has no more steps than seconds; it is raised to the best bound.
//   3. A* over labels (cost, seconds, cheapest cell so far). Waiting is left out, because all of it may
//      be done in the cheapest cell of a way; a label that comes earlier and pays its wait dominates.
//   4. Where labels multiply, second by second over the cells that the bounds leave.
// Steps 1 and 2 are O(cells log(largest cost)) a flood, at most 13 floods; step 4 is never more than the
// sweep of every cell in every second. Memory: 13 bytes a cell for each of 13 bounds at worst, 20 a cell
// besides, 40 a label, and about sqrt(seconds) layers of step 4.
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
