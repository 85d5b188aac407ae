#include "outrider/path/dijkstra.hpp"

#include "octile_search.hpp"

namespace outrider {

std::vector<Option> describe(DijkstraOptions& /*options*/) { return {}; }

Outcome<Plan> dijkstra(const Problem& problem, const DijkstraOptions& /*options*/, const Budget& budget,
                       Workspace& workspace) {
  return octile_search(problem, 0.0, budget, workspace);
}

}  // namespace outrider
