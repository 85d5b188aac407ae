// The shortest of the widest paths: as far from everything as can be, then as short as can be.
//
// Finds the largest clearance (distance to the nearest edge) that any path of the disk from start to goal can
// keep, on the medial axis as in medial_axis.hpp; then the shortest path of a disk of that radius, as
// visibility_graph.hpp does, with its legs and true arcs. `kept` takes a share of the largest clearance
// instead, never less than the robot's radius: from 1 to 0 it runs through all best trades of clearance for
// length, down to the shortest path. Both steps are exact; what rounding takes from the clearance is at most
// 2^-28 of the map and a billionth.
//
// Complete as medial_axis.hpp is. cost is the length; lower_bound is the cost: no path that keeps as much
// clearance is shorter. Counters and trace are those of both searches. Memory and faults: as medial_axis.hpp.
// Sources: O'Dunlaing and Yap (1985); Liu and Arimoto (1992).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct WidestOptions {
  double kept = 1.0;
};
std::vector<Option> describe(WidestOptions& options);

Outcome<Plan> widest(const Problem& problem, const WidestOptions& options, const Budget& budget,
                     Workspace& workspace);

}  // namespace outrider
