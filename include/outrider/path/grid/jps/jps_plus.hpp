// Jump point search with an index that stores the length of each run from each cell.
//
// This is the search of jps.hpp with every straight run replaced by one look-up. A diagonal run jumps
// directly to the next cell at which a straight run to one of its sides leads to a turn.
//
// Complete and optimal among paths along the eight moves of the grid; lengths are kept exactly as m + sqrt(2)
// n cells, and lower_bound is the cost. Accepts only the model `cells`, with sides up to 32767. The first
// query on a ground builds the index and finds the dead ends: O(cells), 20 bytes per cell in the workspace,
// which also keeps the ground. On another ground of the same frame that differs in at most one cell in 32,
// only the runs whose lengths change are computed again; the index equals one built from scratch. Dead ends
// follow as in jps.hpp, with the same consequence for counters. Faults: those of grid_query();
// bad_input for the model `corners` or a longer side; no_path (proven at this resolution); budget_exhausted;
// cancelled. Sources: Rabin and Silva, JPS+: an extreme A* speed optimization for static uniform cost grids
// (2015); Harabor and Grastien, Improving jump point search (2014).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The planner has no options.
struct JpsPlusOptions {};
std::vector<Option> describe(JpsPlusOptions& options);

/// Plans a path as described above.
Outcome<Plan> jps_plus(const Problem& problem, const JpsPlusOptions& options, const Budget& budget,
                       Workspace& workspace);

}  // namespace outrider
