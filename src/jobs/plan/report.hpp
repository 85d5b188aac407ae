// Which of several paths a report tells of.
#pragma once

#include "outrider/jobs/plan/answer.hpp"

namespace outrider {

/// The row of the shortest path, null where none was found. Planners on polygons come first: one on their
/// grid starts and ends at vertices, and may look shorter than the shortest path.
const PlanRow* shortest(const std::vector<const PlanRow*>& rows);

}  // namespace outrider
