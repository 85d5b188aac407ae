// The search that the planners on polygons share: A* over the legs of a tangent graph, or Dijkstra's
// algorithm where there are several goals.
#pragma once

#include "outrider/path/visibility/visibility_graph.hpp"
#include "tangent_graph.hpp"

namespace outrider {

/// From the start of the problem to its goal at the least weights.
Outcome<Plan> tangent_search(const Problem& problem, const CostWeights& weights,
                             const VisibilityOptions& options, TangentForm form, const Budget& budget,
                             Workspace& workspace);

/// From the start of the problem to each of the goals, in one search; the problem's own goal is not used.
std::vector<Outcome<Plan>> tangent_search_many(const Problem& problem, const std::vector<Vec2>& goals,
                                               const CostWeights& weights, const VisibilityOptions& options,
                                               TangentForm form, const Budget& budget, Workspace& workspace);

}  // namespace outrider
