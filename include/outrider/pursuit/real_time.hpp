// LRTA* and RTAA*: reference methods, kept for comparison and to show where they fail.
//
// Each second the robot searches a few cells around it, towards the cell where the target is now, learns
// better estimates for the cells it has searched, and makes one move. LRTA* searches its own cell only;
// RTAA* `lookahead` cells by A*. Neither looks at the trajectory, so nothing is planned ahead: they follow.
// A target as fast as the robot that goes away from it is never caught; one that comes near, stops or
// turns back is, at no bounded cost. What was learned for one cell of the target holds for the next only as
// far as it has not moved: estimates are kept as surplus over the straight distance.
//
// Not complete, not optimal; lower_bound is 0. O(seconds lookahead log lookahead).
// Source: Korf, Real-time heuristic search, 1990; Koenig and Likhachev, Real-time adaptive A*, 2006; Ishida
// and Korf, Moving target search, 1991, who ask for a target that is slower than the robot.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/pursuit/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// LRTA* has no options.
struct LrtaStarOptions {};
std::vector<Option> describe(LrtaStarOptions& options);

/// Options of RTAA*.
struct RtaaStarOptions {
  std::int64_t lookahead = 250;  ///< number of cells searched each second
};
std::vector<Option> describe(RtaaStarOptions& options);

/// Simulate the robot second by second. Faults: those of check(problem); budget_exhausted when the target was
/// gone before it was caught.
Outcome<PursuitPlan> lrta_star(const PursuitProblem& problem, const LrtaStarOptions& options,
                               const Budget& budget, Workspace& workspace);
Outcome<PursuitPlan> rtaa_star(const PursuitProblem& problem, const RtaaStarOptions& options,
                               const Budget& budget, Workspace& workspace);

}  // namespace outrider
