// What the job guard does instead of a mission: writes its decision problem as PDDL, or judges a plan for it.
#pragma once

#include "outrider/job/job.hpp"
#include "outrider/jobs/guard/scenario.hpp"

namespace outrider {

/// Writes domain.pddl, problem.pddl and our plan.txt, or judges the plan that the scenario names. Metrics:
/// stops, poses, targets, makespan_s of our plan, lower_bound_s and whether that is proven; of a judged plan
/// actions, makespan_s and our_makespan_s. A plan that is not valid is not done, and the reason says where it
/// breaks.
Status run_pddl(const GuardScenario& scenario, Run& run, const RunWatch& watch);

}  // namespace outrider
