#include "outrider/path/mesh/polyanya/polyanya.hpp"

#include "polyanya_search.hpp"

namespace outrider {

std::vector<Option> describe(PolyanyaOptions& /*options*/) { return {}; }

Outcome<Plan> polyanya(const Problem& problem, const PolyanyaOptions& /*options*/, const Budget& budget,
                       Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  if (query->ground.model != GridModel::corners) {
    return bad_input("polyanya takes grids of the model 'corners', not 'cells'; take theta_star instead",
                     "planner");
  }
  auto& memory = workspace.get<polyanya_search::Memory>();
  BudgetMeter meter(budget);
  if (!memory.renew(problem.grid, budget.stop)) return meter.refusal();
  polyanya_search::Search search(memory, *query, workspace.trace);
  auto way = search.run(meter);
  if (!way) return pass_on(way);

  double cost = 0.0;
  for (std::size_t i = 1; i < way->size(); ++i) cost += polyanya_search::length((*way)[i - 1], (*way)[i]);
  cost *= query->ground.frame.resolution_m;
  return plan_along(problem, *way, cost, cost, {meter.spent(), search.generated, 0});
}

}  // namespace outrider
