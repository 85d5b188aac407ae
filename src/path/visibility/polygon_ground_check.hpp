// The verification of plans on polygons. It shares no clearance test and no index with the planners.
#pragma once

#include "outrider/path/plan.hpp"

namespace outrider {

/// Verifies a plan as check() describes, each piece against every edge. O(pieces n).
Status check_on_polygons(const Plan& plan, const Problem& problem);

}  // namespace outrider
