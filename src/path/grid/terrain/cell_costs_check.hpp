// The judge's own integral of costs per metre along a path on a grid.
#pragma once

#include "outrider/path/plan.hpp"

namespace outrider {

/// Returns the integral along the legs between the vertices of a plan, m eq. It cuts each leg at every line
/// of the grid and takes the cell of the middle of each part; it shares no code with cost_of_leg(). O(parts
/// log parts) for each leg.
double weighted_length(const Plan& plan, const GridMap& ground, const CellCosts& costs);

}  // namespace outrider
