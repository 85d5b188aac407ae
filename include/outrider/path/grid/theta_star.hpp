// Theta* on a grid: A* whose legs may have any direction.
//
// A vertex takes its grandparent as its parent if it sees it. Lazy Theta* assumes that it does and tests the
// line of sight only when the vertex is expanded, so it needs one test for each expansion. Complete. Not
// optimal, but usually close; lower_bound is the straight distance from start to goal. Accepts both grid
// models. O(n log n), plus one line of sight for each improving neighbour (lazy: for each expansion). Faults:
// those of grid_query(); no_path (proven at this resolution); budget_exhausted; cancelled. Sources: Nash,
// Daniel, Koenig and Felner, Theta*: any-angle path planning on grids (2007); Nash, Koenig and Tovey, Lazy
// Theta* (2010).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The planner has no options.
struct ThetaStarOptions {};
std::vector<Option> describe(ThetaStarOptions& options);

/// Plans a path with Theta*.
Outcome<Plan> theta_star(const Problem& problem, const ThetaStarOptions& options, const Budget& budget,
                         Workspace& workspace);

/// The planner has no options.
struct LazyThetaStarOptions {};
std::vector<Option> describe(LazyThetaStarOptions& options);

/// Plans a path with Lazy Theta*.
Outcome<Plan> lazy_theta_star(const Problem& problem, const LazyThetaStarOptions& options,
                              const Budget& budget, Workspace& workspace);

}  // namespace outrider
