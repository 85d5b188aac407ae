// The least minimum that descents from several starts find.
#pragma once

#include "graph/trust_region.hpp"

namespace outrider {

/// Descends from the start that the options name. With "best", descends from one start after the other until
/// the first end is proven to be the least or two descents agree, and keeps the lowest end. With "staircase",
/// descends from its top. Fault: no such start, or no budget for a single step.
template <class Pose>
Outcome<PoseGraphSolutionOf<Pose>> search_minimum(const PoseGraphOf<Pose>& graph,
                                                  const PoseGraphOptions& options, BudgetMeter& meter);

}  // namespace outrider
