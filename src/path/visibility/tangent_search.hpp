// The common search of the planners on polygons: A* over the legs of a tangent graph, or Dijkstra's algorithm
// for several goals.
#pragma once

#include "outrider/path/visibility/visibility_graph.hpp"
#include "tangent_graph.hpp"

namespace outrider {

/// Plans from the start of the problem to its goal at the least cost.
Outcome<Plan> tangent_search(const Problem& problem, const CostWeights& weights,
                             const VisibilityOptions& options, TangentForm form, const Budget& budget,
                             Workspace& workspace);

/// Plans from the start of the problem to each of the goals, in one search; the goal of the problem is not
/// used.
std::vector<Outcome<Plan>> tangent_search_many(const Problem& problem, const std::vector<Vec2>& goals,
                                               const CostWeights& weights, const VisibilityOptions& options,
                                               TangentForm form, const Budget& budget, Workspace& workspace);

}  // namespace outrider
