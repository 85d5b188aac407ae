// Dijkstra's algorithm on a grid, in all directions until the goal is reached.
//
// Complete and optimal among paths along the eight moves of the grid; lower_bound is the cost. Takes
// both grid models. O(n log n) for the n vertices nearer than the goal. Faults: those of grid_query();
// no_path (proven at this resolution); budget_exhausted; cancelled.
// Source: Dijkstra, A note on two problems in connexion with graphs (1959).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct DijkstraOptions {};
std::vector<Option> describe(DijkstraOptions& options);

Outcome<Plan> dijkstra(const Problem& problem, const DijkstraOptions& options, const Budget& budget,
                       Workspace& workspace);

/// Many goals from one start: the answers of as many single queries, byte for byte but for the counters,
/// which are those of the whole search, in one search that ends with the last goal. The goal of the problem
/// is not used. When the budget ends the search, the goals reached before are answered.
std::vector<Outcome<Plan>> dijkstra_many(const Problem& problem, const std::vector<Vec2>& goals,
                                         const DijkstraOptions& options, const Budget& budget,
                                         Workspace& workspace);

}  // namespace outrider
