// Safe paths along the medial axis, the set of points at which two obstacles are equally near.
//
// The clearance of a point is its distance to the nearest edge. The exposure of a path is the integral of 1 /
// clearance along it. From the start and from the goal, the planner first moves straight away from the
// nearest edge until it meets the axis. It then proceeds in two steps:
//   1. It finds the largest clearance that any path from start to goal can keep, and discards all parts of
//      the axis with less than `kept` times that clearance.
//   2. On the rest of the axis it finds the path of least length + weight * exposure, m.
// No path of the disk keeps more clearance than the widest path on the axis: any path can be retracted to the
// axis without coming nearer to an edge (O'Dunlaing and Yap 1985). The axis is a generalised Voronoi diagram
// of straight lines and parabolas. Clearance, length and exposure of its parts are closed forms, so both
// steps are exact along it.
//
// In the open the best path leaves the axis. So the path along the axis is bent until it costs least in its
// neighbourhood (exposure_descent.hpp), and so is the shortest path that keeps the clearance of step 1; the
// better one is taken. The plan is made of few straight legs: a leg replaces a part of the path if it costs
// at most 1 + `slack` times as much and keeps 0.999 of the clearance required in step 1 (and the radius). So
// the cost is at most 1.001 + slack times the optimum along the axis.
//
// lower_bound holds for every path of the disk that keeps as much clearance as the plan must: it is proven by
// a function whose slope is nowhere above the cost of a metre, on `bound_cells` cells (exposure_bound.hpp),
// or follows from the distance and from the fastest possible growth of clearance, whichever is larger. The
// exposure of the legs is accurate to 0.1 %.
//
// Complete, with one exception: passages wider than the disk by less than 2^-28 of the map size count as
// closed, because corners are rounded to 2^-30 of it. The axis is built at the first query on a ground, in
// O(n^2) for n edges, and kept in the workspace. A query takes O(n log n), and O(n) for each leg tried.
// Counters and trace cover the two searches on the axis and that for the shortest path. Faults: those of
// polygon_query(); bad_input for an option out of range; no_path; budget_exhausted; cancelled. Sources:
// O'Dunlaing and Yap, A retraction method for planning the motion of a disc (1985); Wein, van den Berg and
// Halperin, Planning high-quality paths and corridors amidst obstacles (2008).
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of medial_axis().
struct MedialAxisOptions {
  double weight_m = 10.0;          ///< clearance at which a metre of path counts twice
  double kept = 1.0;               ///< fraction of the largest possible clearance that the path keeps
  double slack = 0.005;            ///< relative extra cost that a straight leg may have
  std::int64_t bound_cells = 128;  ///< cells along the longer side for the lower bound; 0: without cells
};
std::vector<Option> describe(MedialAxisOptions& options);

/// Plans a path as described above.
Outcome<Plan> medial_axis(const Problem& problem, const MedialAxisOptions& options, const Budget& budget,
                          Workspace& workspace);

/// Returns the medial axis of the free space as polylines, for pictures. Parabolas deviate from their chords
/// by at most a hundredth of their clearance.
std::vector<std::vector<Vec2>> medial_axis_lines(const PolygonGround& ground);

}  // namespace outrider
