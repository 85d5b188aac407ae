// The exact search: A* over (goals served, stop, heading, gun), with dominance.
#pragma once

#include <optional>

#include "local_search/route.hpp"
#include "outrider/core/budget.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider::tour {

struct Exact {
  std::vector<std::uint32_t> nodes;  ///< a faster tour than the given one; empty when none was found
  double lower_bound = 0.0;
  bool finished = false;  ///< the best tour known is optimal
  std::uint64_t expansions = 0;
};

/// True when the memory and the time of relax() for all goals are within bounds.
bool exact_is_possible(const Instance& instance);

/// Looks for a tour faster than `known_cost`. When the expansions or the budget end first, the lower
/// bound is the least estimate that was still open.
Exact search_exactly(const Instance& instance, double known_cost, const TourOptions& options,
                     BudgetMeter& meter);

}  // namespace outrider::tour
