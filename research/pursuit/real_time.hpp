// LRTA* and RTAA*: reference methods for comparison, and to show where they fail.
//
// Each second the robot searches a few cells around it towards the present cell of the target, learns better
// heuristic values for the searched cells, and makes one move. LRTA* searches only the robot's own cell;
// RTAA* searches `lookahead` cells by A*. Neither uses the trajectory of the target, so they follow it
// instead of intercepting it. A target that moves away as fast as the robot is never caught. A target that
// approaches, stops or turns back is caught, at a cost without bound. Values learned while the target is in
// one cell are exact only while it stays there, so they are stored as surplus over the straight distance.
//
// Not complete and not optimal; lower_bound is 0. O(seconds lookahead log lookahead).
// Sources: Korf, Real-time heuristic search, 1990; Koenig and Likhachev, Real-time adaptive A*, 2006; Ishida
// and Korf, Moving target search, 1991, which requires a target slower than the robot.
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

/// Simulate the robot second by second. Faults: those of check(problem); budget_exhausted if the target was
/// not caught before its last second.
Outcome<PursuitPlan> lrta_star(const PursuitProblem& problem, const LrtaStarOptions& options,
                               const Budget& budget, Workspace& workspace);
Outcome<PursuitPlan> rtaa_star(const PursuitProblem& problem, const RtaaStarOptions& options,
                               const Budget& budget, Workspace& workspace);

}  // namespace outrider
