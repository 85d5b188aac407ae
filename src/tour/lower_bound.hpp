// A lower bound on every tour of the given stops, for any number of goals.
#pragma once

#include "instance.hpp"
#include "outrider/core/budget.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider::tour {

/// Some of the goals are toured exactly on relaxed drives; the others add their least durations. The
/// goals are chosen one by one: the one that the relaxed tour would go farthest out of its way for
/// (decremental state space relaxation; Righini and Salani, 2008). It ends at `bound_goals` goals, when the
/// tour comes by every goal, at a limit of work, or with the budget; the bound so far is valid always.
double lower_bound(const Instance& instance, const TourOptions& options, BudgetMeter& meter);

}  // namespace outrider::tour
