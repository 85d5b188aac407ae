#include "outrider/path/grid/dijkstra.hpp"

#include "octile_search.hpp"

namespace outrider {

std::vector<Option> describe(DijkstraOptions& /*options*/) { return {}; }

Outcome<Plan> dijkstra(const Problem& problem, const DijkstraOptions& /*options*/, const Budget& budget,
                       Workspace& workspace) {
  return octile_search(problem, 0.0, budget, workspace);
}

std::vector<Outcome<Plan>> dijkstra_many(const Problem& problem, const std::vector<Vec2>& goals,
                                         const DijkstraOptions& /*options*/, const Budget& budget,
                                         Workspace& workspace) {
  return octile_search_many(problem, goals, budget, workspace);
}

}  // namespace outrider
