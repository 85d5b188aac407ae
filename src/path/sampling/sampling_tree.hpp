// What a sampling planner has in the end, as a trace.
#pragma once

#include <ompl/base/Planner.h>

#include "outrider/core/trace.hpp"
#include "sampling_space.hpp"

namespace outrider {

/// The points that are joined to the start, in the order in which they were met, with their parents on the
/// shortest ways along the planner's graph. O(n log n) for n legs of it.
void trace_tree(const ompl::base::Planner& planner, const Problem& problem, const Met& met, Trace& trace);

}  // namespace outrider
