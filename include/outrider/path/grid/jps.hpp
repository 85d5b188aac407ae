// Jump point search on a grid, bit-parallel: A* that runs over the cells at which no turn can pay.
//
// Of the many shortest paths between two cells only those are followed that go diagonally first, and
// only the cells at which a blocked cell forces a turn are expanded. Straight runs are scanned 64 cells
// at a time; a diagonal run scans to both sides at each of its cells, and what these scans find is
// reached from the beginning of the diagonal, whose cells never wait in the queue.
//
// Complete; optimal among paths along the eight moves of the grid, with the length kept exactly as m +
// sqrt(2) n cells; lower_bound is the cost. Takes the model `cells` alone. The first query on a ground writes
// it down as bits, O(cells), half a byte a cell in the workspace, which also keeps the ground; on another
// ground of the same frame it writes only the cells that differ, when they are few. Later queries touch only
// what they scan, and keep about 80 bytes for each jump point that they meet. Faults: those of grid_query();
// bad_input on the model `corners`; no_path (proven at this resolution); budget_exhausted; cancelled.
// Sources: Harabor and Grastien, Online graph pruning for pathfinding on grid maps (2011), The JPS
// pathfinding system (2012, without cutting of corners) and Improving jump point search (2014, blocks of
// bits and pruning of diagonal jump points).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct JpsOptions {};
std::vector<Option> describe(JpsOptions& options);

Outcome<Plan> jps(const Problem& problem, const JpsOptions& options, const Budget& budget,
                  Workspace& workspace);

}  // namespace outrider
