// bounded_tour(): the plan of plan_guard(), with a larger bound for missions on the move.
#pragma once

#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"

namespace outrider {

/// Returns the bound of mission_bound() for missions on the move, or that with turns and halts for the same
/// targets (heading_bound.hpp) if it is larger, s. Memory and time are those of both.
double bound_with_headings(const GuardProblem& problem, const FiringMap& firing_map,
                           const std::vector<std::size_t>& targets, const GuardOptions& options,
                           const Budget& budget);

/// Plans as plan_guard() does. The bounds of a plan on the move are those of bound_with_headings().
Outcome<GuardPlan> bounded_tour(const GuardProblem& problem, const FiringMap& firing_map,
                                const GuardOptions& options, const Budget& budget,
                                const DraftObserver& observe);

}  // namespace outrider
