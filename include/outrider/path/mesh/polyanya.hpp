// Polyanya: the shortest path in any direction, by A* over cones of sight on a navigation mesh.
//
// A node is a root, the place where the path turned last, and the cone in which it looks on through a
// side of a polygon. Expanded, it looks over the other sides: each that lies in the cone makes a node
// behind it, each corner of an obstacle at which the path can turn a node of which it is the root. f is the
// length to the root and on, through the side, to the goal, mirrored in the side when it lies on this side
// of it. Cones are bounded by corners, not by computed points, so all decisions are taken in whole numbers.
//
// Complete; optimal among all paths in the model, with lower_bound the cost. Takes the model `corners` alone.
// The first query on a ground makes its mesh (mesh.hpp), which the workspace keeps. On a ground that differs
// in few cells the mesh follows where they are (mesh_change.hpp); it is made anew when more than a cell in 32
// differs, or when its sides and the gaps among them have come to half as many again. Status, cost and
// bound are those of a new workspace, the cost to 1e-12 of itself, where the budget lasts for the expansions;
// those, and which of equally long paths is found, depend on what the workspace has met before.
//
// A query takes O(n log n) for the n nodes whose f is not above the optimum, and 64 bytes for each. Faults:
// those of grid_query(); bad_input on the model `cells`; no_path (proven at this resolution);
// budget_exhausted; cancelled. Sources: Cui, Harabor and Grastien, Compromise-free pathfinding on a
// navigation mesh (2017); turns by the quadrant of the blocked cell, Oh and Leong, Edge N-level sparse
// visibility graphs (2017).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct PolyanyaOptions {};
std::vector<Option> describe(PolyanyaOptions& options);

Outcome<Plan> polyanya(const Problem& problem, const PolyanyaOptions& options, const Budget& budget,
                       Workspace& workspace);

}  // namespace outrider
