// Paths over cells with costs, drawn together and shifted until they cost no less.
#pragma once

#include "outrider/path/grid/grid_map.hpp"
#include "outrider/path/grid/terrain/cell_costs.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

/// Returns a path between the same ends that costs at most as much as the one over `vertices`, whose legs are
/// legal. It takes turns at leaving out vertices, by the cheapest way over some of them in their order (a leg
/// leaves out 31 at most), and at moving single vertices to a neighbouring cell, until neither helps, or 16
/// times. Costs null: a metre costs 1. Counts the lines of sight that it tests. O(vertices) legs a round.
std::vector<Cell> refined_path(const GridMap& ground, const CellCosts* costs, std::vector<Cell> vertices,
                               PlanCounters& counters);

/// Returns the cost of a leg in cells; its length if `costs` is null.
double leg_cost(const CellCosts* costs, Cell from, Cell to);

/// Returns the sum of the legs.
double path_cost(const CellCosts* costs, const std::vector<Cell>& vertices);

}  // namespace outrider
