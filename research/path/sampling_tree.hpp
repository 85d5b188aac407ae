// The final tree of a sampling planner as a trace.
#pragma once

#include <ompl/base/Planner.h>

#include "outrider/core/trace.hpp"
#include "research/path/sampling_space.hpp"

namespace outrider {

/// Reports the points that are joined to the start, in the order in which they first occurred, with their
/// parents on the shortest paths along the graph of the planner. O(n log n) for its n legs.
void trace_tree(const ompl::base::Planner& planner, const Problem& problem, const Met& met, Trace& trace);

}  // namespace outrider
