// Free-direction A* (Theta*) on a grid: paths whose legs may point anywhere.
//
// A* in which a vertex takes its parent's parent as its own when it sees it. The lazy form believes
// that it does until the vertex is expanded, and so looks along one line for each expansion.
// Complete; not optimal, but near: lower_bound is the straight distance, which no path undercuts. Takes
// both grid models. O(n log n) plus one line of sight for each improving neighbour (lazy: each
// expansion). Faults: those of grid_query(); no_path (proven at this resolution); budget_exhausted;
// cancelled.
// Sources: Nash, Daniel, Koenig and Felner, Theta*: any-angle path planning on grids (2007); Nash,
// Koenig and Tovey, Lazy Theta* (2010).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct ThetaStarOptions {};
std::vector<Option> describe(ThetaStarOptions& options);

Outcome<Plan> theta_star(const Problem& problem, const ThetaStarOptions& options, const Budget& budget,
                         Workspace& workspace);

struct LazyThetaStarOptions {};
std::vector<Option> describe(LazyThetaStarOptions& options);

Outcome<Plan> lazy_theta_star(const Problem& problem, const LazyThetaStarOptions& options,
                              const Budget& budget, Workspace& workspace);

}  // namespace outrider
