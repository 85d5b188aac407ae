// Dijkstra's algorithm on a grid: expands vertices in all directions until it reaches the goal.
//
// Complete and optimal among paths along the eight moves of the grid; lower_bound is the cost. Accepts both
// grid models. O(n log n) for the n vertices nearer than the goal. Faults: those of grid_query(); no_path
// (proven at this resolution); budget_exhausted; cancelled. Source: Dijkstra, A note on two problems in
// connexion with graphs (1959).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The planner has no options.
struct DijkstraOptions {};
std::vector<Option> describe(DijkstraOptions& options);

/// Plans a path as described above.
Outcome<Plan> dijkstra(const Problem& problem, const DijkstraOptions& options, const Budget& budget,
                       Workspace& workspace);

/// Plans from the start to each of the goals in one search, which ends with the last goal. The answers are
/// those of single queries, byte for byte, except for the counters, which are those of the whole search. The
/// goal of the problem is not used. If the budget ends the search, the goals reached before are answered.
std::vector<Outcome<Plan>> dijkstra_many(const Problem& problem, const std::vector<Vec2>& goals,
                                         const DijkstraOptions& options, const Budget& budget,
                                         Workspace& workspace);

}  // namespace outrider
