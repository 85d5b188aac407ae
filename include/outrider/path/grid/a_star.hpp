// A* on a grid with the octile distance as heuristic.
//
// Complete. With weight 1 the path is optimal among paths along the eight moves of the grid, and lower_bound
// is the cost. With a larger weight the path is at most `weight` times as long, and lower_bound is the larger
// of cost / weight and the octile distance. A shortest path in any direction is at least cos(22.5 degrees) =
// 0.924 of the optimum along the moves. Accepts both grid models. O(n log n) for the n vertices whose f is at
// most the optimum. Faults: those of grid_query(); bad_input for a weight below 1 or above 100; no_path
// (proven at this resolution); budget_exhausted; cancelled. Sources: Hart, Nilsson and Raphael (1968); Pohl
// (1970) for the weight.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of a_star().
struct AStarOptions {
  double weight = 1.0;  ///< weight of the heuristic, 1 to 100
};
std::vector<Option> describe(AStarOptions& options);

/// Plans a path as described above.
Outcome<Plan> a_star(const Problem& problem, const AStarOptions& options, const Budget& budget,
                     Workspace& workspace);

}  // namespace outrider
