// A* on a grid, with one of three heuristics and one of two rules for ties.
//
// The heuristic is the distance to the goal without obstacles: the octile distance, along the eight moves;
// the Euclidean distance; or the Chebyshev distance, the larger of the differences in x and in y. None
// exceeds the octile distance, which therefore expands least. Among vertices of equal f, the one with the
// largest g is expanded first (it is nearest to the goal, by the heuristic), or the one with the smallest.
//
// Complete. With weight 1 the path is optimal among paths along the eight moves of the grid, and lower_bound
// is the cost. With a larger weight the path is at most `weight` times as long, and lower_bound is the larger
// of cost / weight and the octile distance. A shortest path in any direction is at least cos(22.5 degrees) =
// 0.924 of the optimum along the moves. Accepts both grid models. O(n log n) for the n vertices whose f is at
// most the optimum. Faults: those of grid_query(); bad_input for a weight below 1 or above 100, or an unknown
// name; no_path (proven at this resolution); budget_exhausted; cancelled. Sources: Hart, Nilsson and Raphael
// (1968); Pohl (1970) for the weight.
#pragma once

#include <string>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of a_star().
struct AStarOptions {
  double weight = 1.0;               ///< weight of the heuristic, 1 to 100
  std::string heuristic = "octile";  ///< octile, euclidean or chebyshev
  std::string ties = "largest_g";    ///< which of equal f comes first: largest_g or smallest_g
};
std::vector<Option> describe(AStarOptions& options);

/// Plans a path as described above.
Outcome<Plan> a_star(const Problem& problem, const AStarOptions& options, const Budget& budget,
                     Workspace& workspace);

}  // namespace outrider
