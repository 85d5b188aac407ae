// The judge of plans on polygons. Shares no clearance test and no index with the planners.
#pragma once

#include "outrider/path/plan.hpp"

namespace outrider {

/// As check() says, piece by piece against every edge. O(pieces n).
Status check_on_polygons(const Plan& plan, const Problem& problem);

}  // namespace outrider
