// Ruin and recreate under simulated annealing: the search for a fast tour of many goals.
#pragma once

#include "outrider/core/budget.hpp"
#include "route.hpp"

namespace outrider::tour {

struct Improvement {
  Route best;
  std::uint64_t iterations = 0;
};

/// Starts from `route` and never ends worse. One expansion of the budget an iteration.
/// Sources: Shaw (1998), large neighbourhood search; Schrimpf et al. (2000), ruin and recreate.
Improvement improve(const Instance& instance, Route route, std::int64_t seed, std::int64_t iterations,
                    BudgetMeter& meter);

}  // namespace outrider::tour
