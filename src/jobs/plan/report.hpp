// Chooses the path that a report describes.
#pragma once

#include "outrider/jobs/plan/answer.hpp"

namespace outrider {

/// Returns the row of the shortest path, or null if none was found. Planners on polygons come first: one on
/// their grid starts and ends at vertices, and may look shorter than the shortest path.
const PlanRow* shortest(const std::vector<const PlanRow*>& rows);

}  // namespace outrider
