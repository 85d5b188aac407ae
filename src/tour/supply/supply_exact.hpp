// The exact search on finite supplies: A* over (goals served, stop, heading, gun, water, charge).
#pragma once

#include "outrider/core/budget.hpp"
#include "supply/supplied.hpp"

namespace outrider::tour {

struct SupplyExact {
  std::vector<std::uint32_t> choices;  // a faster tour than the given one; empty when none was found
  bool finished = false;               // the best tour known is optimal, or none exists
  std::uint64_t expansions = 0;
};

/// True when the estimate fits in memory.
bool exact_is_possible(const Supplied& supplied);

/// Looks for a tour of all goals faster than `known_cost`, which may be infinite.
///
/// The estimate is that of relax(), which knows nothing of supplies, over drives that may lead by depots. Of
/// two labels with the same goals served at the same stop, A dominates B when A can do all that B does, after
/// it has made up for its heading and its gun, which takes `slack` at most and passes before B's next fill:
///     time(A) + slack <= time(B),  water(A) >= water(B),  charge(A) - per_second slack >= charge(B).
/// If a depot stands at the stop itself, A might have to turn only after that fill; then the headings must be
/// the same.
SupplyExact search_exactly(const Supplied& supplied, double known_cost, std::uint64_t expansions,
                           BudgetMeter& meter);

}  // namespace outrider::tour
