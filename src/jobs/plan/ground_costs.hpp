// The cost of a metre on each cell of a ground, from a cost map and the slopes of a terrain.
#pragma once

#include "outrider/jobs/plan/ground.hpp"

namespace outrider {

/// Returns the costs of the cells of the grid, or null if the options ask for none. The cost of a cell is
/// that of the cost map (1 without one) plus `per_slope` times the tangent of the slope at its centre.
/// Faults: those of costs_of(), and a cost that CellCosts refuses, with the file.
Outcome<std::shared_ptr<const CellCosts>> ground_costs(const PlanCostOptions& options, const GridFrame& frame,
                                                       double yaw_rad);

}  // namespace outrider
