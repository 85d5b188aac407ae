// What every guard planner begins and ends with.
#pragma once

#include "outrider/guard/plan.hpp"

namespace outrider {

/// A plan without stops: its places counted, the targets without a firing region told unreachable.
GuardPlan begin_plan(const GuardProblem& problem, const Site& site, const GuardOptions& options);

/// Joins the stops, from the start on, by the drives that are fastest with the turn before them, and finds
/// the cost of the whole. Refused as site_routes().
Status finish_plan(const GuardProblem& problem, const Site& site, const Budget& budget, GuardPlan& plan);

}  // namespace outrider
