// Points, queries and cells in the text of a scenario.
#pragma once

#include <vector>

#include "outrider/jobs/plan/answer.hpp"

namespace outrider {

/// From `from` to each of `to`, or the queries of the map that `query` names. Fault: bad_input with the key.
Outcome<std::vector<PlanQuery>> queries_of(const PlanScenario& scenario, const LoadedMap& map);

/// All of `block`, then all of `free`. Fault: bad_input with the key and its value.
Outcome<std::vector<PlanCellChange>> cell_changes(const PlanScenario& scenario);

}  // namespace outrider
