// The shortest of the widest paths: the path keeps the largest possible clearance, and is then as short as
// possible.
//
// The planner first finds the largest clearance (distance to the nearest edge) that any path of the disk from
// start to goal can keep, on the medial axis as in medial_axis.hpp. It then finds the shortest path of a disk
// of that radius as visibility_graph.hpp does, with its legs and true arcs. `kept` requires only a fraction
// of the largest clearance, but never less than the radius of the robot: values from 1 to 0 yield all optimal
// compromises of clearance and length, down to the shortest path. Both steps are exact. Rounding costs at
// most 2^-28 of the map size plus a billionth of the clearance.
//
// Complete in the same sense as medial_axis.hpp. The cost is the length, and lower_bound is the cost: no path
// that keeps as much clearance is shorter. Counters and trace cover both searches. Memory and faults: as in
// medial_axis.hpp. Sources: O'Dunlaing and Yap (1985); Liu and Arimoto (1992).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of widest().
struct WidestOptions {
  double kept = 1.0;  ///< fraction of the largest possible clearance that the path keeps
};
std::vector<Option> describe(WidestOptions& options);

/// Plans a path as described above.
Outcome<Plan> widest(const Problem& problem, const WidestOptions& options, const Budget& budget,
                     Workspace& workspace);

}  // namespace outrider
