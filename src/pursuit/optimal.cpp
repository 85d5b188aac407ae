#include "outrider/pursuit/optimal.hpp"

#include <fmt/format.h>

#include "outrider/pursuit/anytime.hpp"

namespace outrider {

std::vector<Option> describe(OptimalPursuitOptions&) { return {}; }

Outcome<PursuitPlan> optimal_pursuit(const PursuitProblem& problem, const OptimalPursuitOptions&,
                                     const Budget& budget, Workspace& workspace) {
  Outcome<PursuitPlan> plan = anytime_pursuit(problem, {}, budget, workspace);
  if (!plan || plan->optimal()) return plan;
  return fault(
      FaultCode::budget_exhausted,
      fmt::format("the budget ended with a catch for {} and the proof that none costs less than {}; take "
                  "the planner 'anytime' to have it, or a larger budget",
                  plan->cost, plan->lower_bound));
}

}  // namespace outrider
