// Iterative A* with penalties and backward goals: a reference method for comparison.
//
// Goals are cells of the target, taken backward from the end of its trajectory. For each goal, A* in space
// alone minimises cost + penalty x steps. If the path arrives too late, the search is repeated with a ten
// times larger penalty, until the path is in time or even the path with the fewest steps is late. A robot
// that arrives early waits at the goal. The result is the cheapest catch over all goals.
//
// Not complete (it tries only `goals` seconds of the trajectory) and not optimal (it waits only at the goal,
// and it misses paths between two penalties). lower_bound is 0: nothing is proven. O(goals log(penalties)
// cells log cells).
// Source: the method of the reference report on map 1-9 (CMU 16-782), from its description.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/pursuit/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of the planner.
struct IterativeAStarOptions {
  std::int64_t goals = 16;  ///< number of seconds tried, spread from the last one back to the first
};
std::vector<Option> describe(IterativeAStarOptions& options);

/// Plans a catch. Faults: those of check(problem); budget_exhausted if no goal was reached in time or the
/// budget ended.
Outcome<PursuitPlan> iterative_a_star(const PursuitProblem& problem, const IterativeAStarOptions& options,
                                      const Budget& budget, Workspace& workspace);

}  // namespace outrider
