// Polyanya: finds the shortest path in any direction by A* over cones of sight on a navigation mesh.
//
// A node is a root (the point at which the path turned last) and the cone in which the root sees through a
// side of a polygon. Expanding a node looks at the other sides of the polygon behind. Each side in the cone
// yields a node behind it, and each obstacle corner at which the path can turn yields a node with that corner
// as root. f is the length to the root plus the length from the root through the side to the goal; a goal on
// the near side is mirrored in the side. Cones are bounded by corners instead of computed points, so all
// decisions are exact in integers.
//
// Turns that no shortest path avoids are taken without a search. Once queries on a ground have expanded as
// many nodes as its mesh has sides, the workspace also keeps the taut legs that leave a turn, and bounds the
// length to the goal by the lengths from one landmark to all turns; the search may then run from the goal.
//
// Complete and optimal among all paths in the model; lower_bound is the cost. Accepts only the model
// `corners`. The first query on a ground builds its mesh (mesh.hpp), which the workspace keeps. On a ground
// that differs in few cells, the mesh is updated where they are (mesh_change.hpp). It is rebuilt if more than
// one cell in 32 differs, or once its sides and gaps have grown by half. Status, cost and bound equal those
// of a new workspace (the cost to a relative 1e-12) if the budget suffices for the expansions. The number of
// expansions, and the choice among paths of equal length, depend on earlier queries in the workspace.
//
// A query takes O(n log n) time and 64 bytes per node for the n nodes whose f is at most the optimum. Beyond
// one query it keeps 28 bytes per turn, and the legs: at most 2 bytes per cell, from 16 MiB to 64. Faults:
// those of grid_query(); bad_input for the model `cells`; no_path (proven at this resolution);
// budget_exhausted; cancelled.
// Sources: Cui, Harabor and Grastien, Compromise-free pathfinding on a navigation mesh (2017); turns by the
// quadrant of the blocked cell, Oh and Leong, Edge N-level sparse visibility graphs (2017); forced turns, Lee
// and Preparata (1984); landmarks, Goldberg and Harrelson (2005).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The planner has no options.
struct PolyanyaOptions {};
std::vector<Option> describe(PolyanyaOptions& options);

/// Plans a path as described above.
Outcome<Plan> polyanya(const Problem& problem, const PolyanyaOptions& options, const Budget& budget,
                       Workspace& workspace);

}  // namespace outrider
