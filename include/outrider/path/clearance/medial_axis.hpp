// Safe paths along the medial axis: the lines on which two obstacles are equally near.
//
// Clearance is the distance from a point to the nearest edge, exposure the integral of 1 / clearance along a
// path. From start and goal the way leads straight away from the nearest edge until it meets the axis, then
//   1. only along parts of the axis that keep the largest clearance that any path at all from start to goal
//      can keep (or at least `kept` times that), and
//   2. of these ways along the one of least length + weight * exposure, m.
// No path of the disk keeps more clearance: what any path passes can be drawn back to the axis and comes no
// nearer to an edge by that (O'Dunlaing and Yap 1985). The axis is a generalised Voronoi diagram, straight
// lines and parabolas, and clearance, length and exposure of its parts are closed forms, so both steps are
// exact along it.
//
// The plan is few straight legs: points of the way are joined where the leg costs at most 1 + `slack` times
// what the way between them does, and keeps 0.999 of what step 1 keeps (and the radius). So cost is at most
// 1.001 + slack times the least along the axis; lower_bound is what no path of the disk undercuts, from the
// distance and from how fast clearance can grow; it is no close bound. The exposure of the legs is found to
// 0.1 %.
//
// Complete, except that ways wider than the disk by less than 2^-28 of the map count as closed: corners are
// rounded to 2^-30 of it. The axis is made at the first query on a ground, O(n^2) for n edges, and stays in
// the workspace; a query takes O(n log n) and O(n) for each leg tried. Faults: those of polygon_query();
// bad_input on an option out of range; no_path; budget_exhausted; cancelled.
// Sources: O'Dunlaing and Yap, A retraction method for planning the motion of a disc (1985); Wein, van den
// Berg and Halperin, Planning high-quality paths and corridors amidst obstacles (2008).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct MedialAxisOptions {
  double weight_m = 10.0;
  double kept = 1.0;
  double slack = 0.005;
};
std::vector<Option> describe(MedialAxisOptions& options);

Outcome<Plan> medial_axis(const Problem& problem, const MedialAxisOptions& options, const Budget& budget,
                          Workspace& workspace);

/// The medial axis of free ground as chains of points, for pictures; parabolas leave their chords by at most
/// a hundredth of their clearance.
std::vector<std::vector<Vec2>> medial_axis_lines(const PolygonGround& ground);

}  // namespace outrider
