// The pictures of an answer, and what a search expanded.
#pragma once

#include <vector>

#include "outrider/core/trace.hpp"
#include "outrider/io/files.hpp"
#include "outrider/jobs/plan/answer.hpp"

namespace outrider {

/// plan.svg; on polygons, where there are several queries, also query_K.svg of each of the first 100 with
/// the paths of all planners, and plan.svg has the shortest of each. `trace` is drawn where there is one.
std::vector<NamedContent> plan_pictures(const PlanQuestion& question, const PlanAnswer& answer,
                                        const Trace* trace);

/// The vertices in the order in which the search expanded them, as a JSON array; costs in cells.
std::string trace_json(const Trace& trace, const GridMap& ground);

}  // namespace outrider
