// Jump point search on a grid, bit-parallel: A* that skips the cells at which no optimal path needs to turn.
//
// Among the many shortest paths between two cells, the search follows only those that go diagonally first,
// and it expands only the cells at which a blocked cell forces a turn. It scans straight runs 64 cells at a
// time. A diagonal run scans to both sides at each of its cells. The jump points found by these scans become
// successors of the first cell of the diagonal; the cells of the diagonal never enter the queue.
//
// Jump points in dead ends, parts of the ground that no shortest path between start and goal enters, are left
// out; the gates that lead from one part to the next give a lower bound. The jump points next to another one
// are scanned by the first query that expands it and kept for the next ones.
//
// Complete and optimal among paths along the eight moves of the grid; lengths are kept exactly as m + sqrt(2)
// n cells, and lower_bound is the cost. Accepts only the model `cells`. The first query on a ground stores it
// as bits and finds its dead ends: O(cells), half a byte and four bytes per cell in the workspace, which also
// keeps the ground; no dead ends above 4 million cells. On another ground of the same frame, only the changed
// cells are written if they are few; dead ends are then found again only after searches that cost as much.
// Until then the counters, and the choice among equally long paths, may differ from those on a new workspace;
// status and cost never do. Later queries touch only the cells that they scan, and keep about 60 bytes for
// each jump point found, and the lists of jump points in at most 64 MiB beyond one query. Faults: those of
// grid_query(); bad_input for the model `corners`; no_path (proven at this resolution); budget_exhausted;
// cancelled. Sources: Harabor and Grastien, Online graph pruning for pathfinding on grid maps (2011), The JPS
// pathfinding system (2012, without corner cutting) and Improving jump point search (2014, blocks of bits and
// pruning of diagonal jump points); Pochter et al., Search space reduction using swamp hierarchies (2010).
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
