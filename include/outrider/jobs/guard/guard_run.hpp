// A whole guard mission, simulated: survey, plan, execute, report.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/plan.hpp"

namespace outrider {

/// Executes the plan on a simulated robot and reports. The report is a pure function of the arguments, the
/// observer left out. status is "done" when every target that can be hit was hit.
Report run_guard(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                 const GuardOptions& options, std::uint64_t seed, const RunWatch& watch = {});

}  // namespace outrider
