// Multi-goal A* in (x, y, t): a reference method for comparison.
//
// States are (cell, second), and every state at which the target is in the cell is a goal. The heuristic is
// the least cost from a cell to any cell of the target, found by a backward search in space. Optimal and
// complete if it terminates. A cell is expanded again in every second, so time and memory grow with cells x
// seconds: on large maps, or where waiting is cheap, it runs out of memory. An option limits the number of
// states. O(states log states) time; 20 bytes per state, and one bit per second for each cell reached.
// Source: Hart, Nilsson and Raphael, A formal basis for the heuristic determination of minimum cost paths,
// 1968, on the time-expanded graph.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/pursuit/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of the planner.
struct MultiGoalAStarOptions {
  std::int64_t states = 20'000'000;  ///< largest number of states in memory
};
std::vector<Option> describe(MultiGoalAStarOptions& options);

/// Plans the cheapest catch. Faults: those of check(problem); no_path if all reachable states were expanded
/// without a catch; budget_exhausted if the budget ended or there are too many states.
Outcome<PursuitPlan> multi_goal_a_star(const PursuitProblem& problem, const MultiGoalAStarOptions& options,
                                       const Budget& budget, Workspace& workspace);

}  // namespace outrider
