// A* on ground that costs more in some cells than in others, along the eight moves or in any direction.
//
// Both minimise the integral of the cost per metre along the path (Problem::costs; CellCosts says what a move
// and a leg cost). Without costs a metre costs 1 everywhere.
//
// terrain_a_star() is complete and optimal among paths along the eight moves of the grid; lower_bound is the
// cost. Its estimate is the octile distance times the least cost per metre of the grid, so it is the better
// led, the less the costs differ.
//
// terrain_theta_star() lets a vertex take the parent of its parent if it sees it and the straight leg costs
// no more than the way through its own parent: Theta* with integrals as lengths. Then it draws the legs of
// its path together where that costs less. Complete; not optimal, since a cheapest path bends at the borders
// of costs, where there are no vertices. lower_bound is the straight distance times the least cost per metre.
//
// Both accept only the model `cells`. O(n log n) for the n vertices that are expanded; in any direction also
// one leg of O(|dx| + |dy|) for each neighbour. Faults: those of grid_query(); bad_input for the model
// `corners`, or costs of another grid; no_path (proven at this resolution); budget_exhausted; cancelled.
// Sources: Hart, Nilsson and Raphael (1968); Nash, Daniel, Koenig and Felner, Theta* (2007), whose cells have
// one cost; Choi and Yu, Any-angle path planning on non-uniform costmaps (2011).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The planner has no options.
struct TerrainAStarOptions {};
std::vector<Option> describe(TerrainAStarOptions& options);

/// Plans a cheapest path along the eight moves.
Outcome<Plan> terrain_a_star(const Problem& problem, const TerrainAStarOptions& options, const Budget& budget,
                             Workspace& workspace);

/// The planner has no options.
struct TerrainThetaStarOptions {};
std::vector<Option> describe(TerrainThetaStarOptions& options);

/// Plans a cheap path in any direction.
Outcome<Plan> terrain_theta_star(const Problem& problem, const TerrainThetaStarOptions& options,
                                 const Budget& budget, Workspace& workspace);

}  // namespace outrider
