#include "outrider/path/grid/d_star_lite.hpp"

#include <algorithm>

#include "incremental_search.hpp"

namespace outrider {
namespace {

struct FromGoal {
  IncrementalSearch search;
};
struct FromStart {
  IncrementalSearch search;
};

Outcome<Plan> repair(const Problem& problem, bool from_goal, IncrementalSearch& search, const Budget& budget,
                     Trace* trace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  BudgetMeter meter(budget);
  if (budget.stop.stop_requested()) return meter.refusal();
  const auto [root, target] =
      from_goal ? std::pair{query->goal, query->start} : std::pair{query->start, query->goal};
  search.prepare(problem.grid, root, target, trace != nullptr);
  if (auto found = search.run(meter, trace); !found) return pass_on(found);
  std::vector<Cell> vertices = search.path();
  if (!from_goal) std::reverse(vertices.begin(), vertices.end());
  const double cost = query->ground.frame.resolution_m * search.cost().value();
  return plan_along(problem, vertices, cost, cost, {meter.spent(), search.generated(), 0});
}

}  // namespace

std::vector<Option> describe(DStarLiteOptions& /*options*/) { return {}; }

Outcome<Plan> d_star_lite(const Problem& problem, const DStarLiteOptions& /*options*/, const Budget& budget,
                          Workspace& workspace) {
  return repair(problem, true, workspace.get<FromGoal>().search, budget, workspace.trace);
}

std::vector<Option> describe(LpaStarOptions& /*options*/) { return {}; }

Outcome<Plan> lpa_star(const Problem& problem, const LpaStarOptions& /*options*/, const Budget& budget,
                       Workspace& workspace) {
  return repair(problem, false, workspace.get<FromStart>().search, budget, workspace.trace);
}

}  // namespace outrider
