// D* Lite and Lifelong Planning A*: A* that keeps its search in the workspace and repairs it where the grid
// has changed.
//
// D* Lite searches from the goal to the start, so its costs stay valid while the start moves: it serves a
// robot that drives towards one goal through a map that it corrects on the way. LPA* searches from the start
// to the goal, so its costs stay valid while the goal moves. Otherwise they are the same.
//
// Both keep two costs for each vertex that they have reached: g, and rhs, the least g of a neighbour plus the
// move from it. Where a changed cell makes the two differ, the vertex returns to the queue, and only such
// vertices are expanded, and only as far as they can matter to the path. A query repairs the kept search if
// its grid differs from the previous one in at most one cell of 32 and the root of the search (D* Lite: the
// goal; LPA*: the start) is the same vertex. Otherwise, and if the workspace has a trace, it searches anew.
// A search that its budget ended is continued by the next query.
//
// Complete and optimal among paths along the eight moves of the grid; lower_bound is the cost. Costs are kept
// exactly as m + sqrt(2) n cells. A kept search returns the same status and cost as a new one, but maybe
// another one of several shortest paths; its counters count only the repair, and are 0 for a repeated query.
// Accepts both grid models. A change near the root can make most vertices differ; repairing them then costs
// up to two expansions each, more than a new search. O(n log n) for the n vertices that are expanded, plus
// the comparison of the two grids, O(cells). Memory in the workspace: 4 bytes for each vertex reached, and
// some 50 for each in the queue. Faults: those of grid_query(); no_path (proven at this resolution);
// budget_exhausted; cancelled. Sources: Koenig and Likhachev, D* Lite (2002); Koenig, Likhachev and Furcy,
// Lifelong Planning A* (2004). Of equal f they expand the smallest g first; here raised costs come first,
// then the largest g, as in a_star(), which expands less (the proof is at the code).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The planner has no options.
struct DStarLiteOptions {};
std::vector<Option> describe(DStarLiteOptions& options);

/// Plans a path with D* Lite.
Outcome<Plan> d_star_lite(const Problem& problem, const DStarLiteOptions& options, const Budget& budget,
                          Workspace& workspace);

/// The planner has no options.
struct LpaStarOptions {};
std::vector<Option> describe(LpaStarOptions& options);

/// Plans a path with Lifelong Planning A*.
Outcome<Plan> lpa_star(const Problem& problem, const LpaStarOptions& options, const Budget& budget,
                       Workspace& workspace);

}  // namespace outrider
