// Visibility graphs among polygons: exact shortest paths of a disk.
//
// The shortest path of the disk's centre consists of straight legs and of arcs around corners with the
// robot's radius; each leg is tangent to the arcs at its ends. The graph joins all such arcs that see each
// other. A* with the straight distance finds the shortest path in it. There are three forms with the same
// result; n counts arcs:
//   visibility_graph           is built in advance by a rotational sweep at every arc: O(n^2 log n), and one
//                              clearance test for each leg that the sweep leaves
//   visibility_graph_reduced   is built in advance from the supporting and separating tangents of pairs of
//                              convex obstacle corners: O(n^2), and one clearance test each
//   visibility_graph_implicit  is not built in advance: an arc is swept when A* reaches it for the first time
// The graphs that are built in advance stay in the workspace for later queries. On another ground of which at
// most half of the edges differ, the graph is updated instead of rebuilt: remaining legs are tested against
// the new edges, and new legs are searched at new arcs and beside removed edges. The result equals a graph
// built from scratch, whatever the order of the changes.
//
// Complete, and optimal among all paths of the disk (contact is tested with the tolerance contact_m): cost
// and lower_bound are the exact length. Plan::pieces are the legs and exact arcs. The waypoints replace each
// arc by tangents that turn by at most `arc_step`; they deviate from it by at most radius (1 / cos(step / 2)
// - 1), stated in waypoint_error_m. With `polygonal`, the pieces are these straight legs: collision-free, and
// at most tan(step / 2) / (step / 2) times as long as the exact path, whose length remains the lower bound.
// If a gap is too narrow for the tangents, the step is halved; if that does not help, the arc remains.
//
// Memory: 48 bytes per leg and direction, and 16 for its label in a search. Faults: those of polygon_query();
// bad_input for a step outside 1 to 90 degrees; no_path (proven); budget_exhausted; cancelled. An expansion
// is one leg expanded by A*. Building the graph counts no expansions, but observes wall time and
// cancellation.
// Sources: Lozano-Perez and Wesley (1979); Lee (1978) for the sweep; Liu and Arimoto, Path planning using a
// tangent graph for mobile robots among polygonal and curved obstacles (1992).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of the visibility graph planners.
struct VisibilityOptions {
  bool polygonal = false;               ///< replace arcs by straight legs in Plan::pieces; slightly longer
  double arc_step_rad = radians(10.0);  ///< largest turn between the straight legs that replace an arc
};
std::vector<Option> describe(VisibilityOptions& options);

/// Plan a path as described above.
Outcome<Plan> visibility_graph(const Problem& problem, const VisibilityOptions& options, const Budget& budget,
                               Workspace& workspace);
Outcome<Plan> visibility_graph_reduced(const Problem& problem, const VisibilityOptions& options,
                                       const Budget& budget, Workspace& workspace);
Outcome<Plan> visibility_graph_implicit(const Problem& problem, const VisibilityOptions& options,
                                        const Budget& budget, Workspace& workspace);

/// Plan from the start to each of the goals in one search without a heuristic, which ends with the last goal.
/// The costs equal those of single queries; among paths of equal cost another one may be found. Counters are
/// those of the whole search. The goal of the problem is not used. If the budget ends the search, the goals
/// reached before are answered.
std::vector<Outcome<Plan>> visibility_graph_many(const Problem& problem, const std::vector<Vec2>& goals,
                                                 const VisibilityOptions& options, const Budget& budget,
                                                 Workspace& workspace);
std::vector<Outcome<Plan>> visibility_graph_reduced_many(const Problem& problem,
                                                         const std::vector<Vec2>& goals,
                                                         const VisibilityOptions& options,
                                                         const Budget& budget, Workspace& workspace);
std::vector<Outcome<Plan>> visibility_graph_implicit_many(const Problem& problem,
                                                          const std::vector<Vec2>& goals,
                                                          const VisibilityOptions& options,
                                                          const Budget& budget, Workspace& workspace);

/// Returns all legs of the graph, each once, found by sweeps or by pairs.
std::vector<Segment> visibility_legs(const PolygonGround& ground, bool swept);

}  // namespace outrider
