// Jump point search on a grid, bit-parallel: A* that skips the cells at which no optimal path needs to turn.
//
// Of the many shortest paths between two cells, the search follows only those that go diagonally first, and
// it expands only the cells at which a blocked cell forces a turn. It scans straight runs 64 cells at a time.
// A diagonal run scans to both sides at each of its cells. The jump points found by these scans become
// successors of the first cell of the diagonal; the cells of the diagonal never enter the queue.
//
// Complete and optimal among paths along the eight moves of the grid; lengths are kept exactly as m + sqrt(2)
// n cells, and lower_bound is the cost. Accepts only the model `cells`. The first query on a ground stores it
// as bits: O(cells), half a byte per cell in the workspace, which also keeps the ground. On another ground of
// the same frame, only the changed cells are written if they are few. Later queries touch only the cells that
// they scan, and keep about 80 bytes for each jump point found. Faults: those of grid_query(); bad_input for
// the model `corners`; no_path (proven at this resolution); budget_exhausted; cancelled. Sources: Harabor and
// Grastien, Online graph pruning for pathfinding on grid maps (2011), The JPS pathfinding system (2012,
// without corner cutting) and Improving jump point search (2014, blocks of bits and pruning of diagonal jump
// points).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The planner has no options.
struct JpsOptions {};
std::vector<Option> describe(JpsOptions& options);

/// Plans a path as described above.
Outcome<Plan> jps(const Problem& problem, const JpsOptions& options, const Budget& budget,
                  Workspace& workspace);

}  // namespace outrider
