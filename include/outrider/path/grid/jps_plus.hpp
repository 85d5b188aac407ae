// Jump point search with an index: how far each run goes from each cell is known beforehand.
//
// The search of jps.hpp, in which a straight run is one look-up, and a diagonal run leaps from one
// cell whose side runs lead to a turn to the next.
//
// Complete; optimal among paths along the eight moves of the grid, with the length kept exactly as m +
// sqrt(2) n cells; lower_bound is the cost. Takes the model `cells` alone, with sides up to 32767. The first
// query on a ground builds the index, O(cells), 16 bytes a cell in the workspace, which also keeps the
// ground. On another ground of the same frame, of which at most a cell in 32 differs, only the runs that end
// otherwise are walked again; the index is the same as one built anew. Faults: those of grid_query();
// bad_input on the model `corners` or a longer side; no_path (proven at this resolution); budget_exhausted;
// cancelled.
// Sources: Rabin and Silva, JPS+: an extreme A* speed optimization for static uniform cost grids (2015);
// Harabor and Grastien, Improving jump point search (2014).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct JpsPlusOptions {};
std::vector<Option> describe(JpsPlusOptions& options);

Outcome<Plan> jps_plus(const Problem& problem, const JpsPlusOptions& options, const Budget& budget,
                       Workspace& workspace);

}  // namespace outrider
