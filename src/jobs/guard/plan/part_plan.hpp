// Plans for some of the targets: what one robot of a team does.
#pragma once

#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"

namespace outrider {

/// Plans like plan_guard(), but hits only `targets`, each of which needs a firing region. Others are neither
/// in a stop nor in `unreachable`. There are no lower bounds. The start of the problem may be any place that
/// is connected with the start for which the firing map was built.
Outcome<GuardPlan> plan_part(const GuardProblem& problem, const FiringMap& firing_map,
                             const std::vector<std::size_t>& targets, const GuardOptions& options,
                             const Budget& budget);

}  // namespace outrider
