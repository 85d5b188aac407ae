#include "terrain_query.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/core/text.hpp"
#include "terrain_refine.hpp"

namespace outrider {

Outcome<GridQuery> terrain_query(const Problem& problem, std::string_view planner) {
  auto query = grid_query(problem);
  if (!query) return query;
  const GridFrame& frame = query->ground.frame;
  if (query->ground.model != GridModel::cells) {
    return bad_input(fmt::format("{} takes grids of the model 'cells', not 'corners'", planner), "planner");
  }
  if (problem.costs != nullptr && !(problem.costs->per_m.frame == frame)) {
    const GridFrame& other = problem.costs->per_m.frame;
    return bad_input(
        fmt::format("the costs are those of a grid of {} x {} cells at ({}, {}), not of this "
                    "one of {} x {} cells at ({}, {})",
                    other.width, other.height, short_number(other.origin.x), short_number(other.origin.y),
                    frame.width, frame.height, short_number(frame.origin.x), short_number(frame.origin.y)));
  }
  return query;
}

Plan priced_plan(const Problem& problem, const std::vector<Cell>& vertices, double bound,
                 const PlanCounters& counters) {
  const double resolution = problem.grid->frame.resolution_m;
  const double cost = path_cost(problem.costs.get(), vertices);
  Plan plan = plan_along(problem, vertices, resolution * cost, resolution * std::min(bound, cost), counters);
  plan.weights.by_cell = problem.costs != nullptr;
  return plan;
}

}  // namespace outrider
