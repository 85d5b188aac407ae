// Multi-goal A* in (x, y, t): a reference method, kept for comparison.
//
// Every (cell of the target, second) is a goal; states are (cell, second); the bound is the least cost from
// a cell to any cell of the target, found backward in space. Optimal and complete where it ends, but it
// looks at a cell again in every second, so time and memory grow with cells x seconds: on large maps, or
// where waiting is cheap, it runs out of memory. The states it may hold are bounded by an option.
// O(states log states) time; 20 bytes a state and a bit for each second of each cell met.
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

/// Plans the cheapest catch. Faults: those of check(problem); no_path when all reachable states were
/// expanded; budget_exhausted when the budget ended or the states are too many.
Outcome<PursuitPlan> multi_goal_a_star(const PursuitProblem& problem, const MultiGoalAStarOptions& options,
                                       const Budget& budget, Workspace& workspace);

}  // namespace outrider
