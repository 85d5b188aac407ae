// Ruin and recreate under simulated annealing: the search for a fast tour of many goals.
#pragma once

#include <functional>

#include "local_search/route.hpp"
#include "outrider/core/budget.hpp"

namespace outrider::tour {

struct Improvement {
  Route best;
  std::uint64_t iterations = 0;
};

inline double cost_of(const Route& route) { return route.cost; }

/// Returns the value of a route, if that is not its cost.
using Price = std::function<double(const Route&)>;

/// Receives each route that is better than all before it.
using Better = std::function<void(const Route&)>;

/// Largest number of iterations for each goal of an instance: with that many, tours of few goals have
/// settled.
inline constexpr std::uint64_t most_rounds_per_goal = 10'000;

/// Starts from `route` and never ends worse, by its price. One expansion of the budget an iteration, of which
/// there are at most `iterations` and `most_rounds_per_goal` for each goal. Sources: Shaw (1998), large
/// neighbourhood search; Schrimpf et al. (2000), ruin and recreate.
Improvement improve(const Instance& instance, Route route, std::int64_t seed, std::int64_t iterations,
                    BudgetMeter& meter, const std::stop_token& stop, const Price& price = &cost_of,
                    const Better& better = {});

}  // namespace outrider::tour
