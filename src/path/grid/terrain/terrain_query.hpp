// The common parts of the planners on ground with costs: their query and their plan.
#pragma once

#include <string_view>
#include <vector>

#include "outrider/path/plan.hpp"

namespace outrider {

/// Returns the query of a problem. Faults: those of grid_query(); bad_input for the model `corners`, or costs
/// of another grid.
Outcome<GridQuery> terrain_query(const Problem& problem, std::string_view planner);

/// Returns the plan along vertices; its lower bound is the least of `bound` and the cost, for cells of
/// side 1.
Plan priced_plan(const Problem& problem, const std::vector<Cell>& vertices, double bound,
                 const PlanCounters& counters);

}  // namespace outrider
