// Visibility graphs among polygons: exact shortest paths of a disk.
//
// The shortest path of the disk's centre consists of straight legs and of arcs about corners grown by
// the radius, each leg tangent to the arcs at its ends. The graph joins all such arcs that see each
// other; A* with the straight distance finds the shortest way in it. Three forms, one answer:
//   visibility_graph           built beforehand by a rotational sweep at every arc, O(n^2 log n) and one
//                              test of clearance for each leg that the sweep leaves
//   visibility_graph_reduced   built beforehand from pairs of convex corners of obstacles that support or
//                              separate, O(n^2) and one test for each
//   visibility_graph_implicit  nothing built beforehand: an arc is swept when A* first comes to it
// The two that are built stay in the workspace for later queries; n counts arcs. On another ground of which
// at most half of the edges differ they are not built again: legs that stay are tested against the new
// edges, legs of new arcs and beside edges that are gone are looked for. The graph is the same as one built
// anew, whatever the order of the changes.
//
// Complete; optimal among all paths of the disk, with contact judged within contact_m: cost and
// lower_bound are the exact length. Plan::pieces are the legs and true arcs; the waypoints replace each
// arc by tangents that turn by at most `arc_step`, so they leave it by at most
// radius (1 / cos(step / 2) - 1), stated in waypoint_error_m. With `polygonal` the pieces are such
// straight legs: at most tan(step / 2) / (step / 2) times as long as the exact path, whose length stays
// the lower bound, and free of collision; where a gap is too narrow for the tangents the step is halved,
// and if that does not help either the arc stays.
//
// Memory 48 bytes a leg in one direction, and 16 for its label in a search. Faults: those of polygon_query();
// bad_input on a step outside 1 to 90 degrees; no_path (proven); budget_exhausted; cancelled. An expansion is
// one leg taken up by A*; building counts none, but heeds wall time and cancellation. Sources: Lozano-Perez
// and Wesley (1979); Lee (1978) for the sweep; Liu and Arimoto, Path planning using a tangent graph for
// mobile robots among polygonal and curved obstacles (1992).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct VisibilityOptions {
  bool polygonal = false;
  double arc_step_rad = radians(10.0);
};
std::vector<Option> describe(VisibilityOptions& options);

Outcome<Plan> visibility_graph(const Problem& problem, const VisibilityOptions& options, const Budget& budget,
                               Workspace& workspace);
Outcome<Plan> visibility_graph_reduced(const Problem& problem, const VisibilityOptions& options,
                                       const Budget& budget, Workspace& workspace);
Outcome<Plan> visibility_graph_implicit(const Problem& problem, const VisibilityOptions& options,
                                        const Budget& budget, Workspace& workspace);

/// Many goals from one start: the answers of as many single queries (equal in cost; among ways of one
/// cost another may be taken), in one search without an estimate that ends with the last goal. Counters
/// are those of the whole search. The goal of the problem is not used. When the budget ends the search,
/// the goals reached before are answered.
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

/// All legs of the graph that is built beforehand, each once, found by sweeps or by pairs.
std::vector<Segment> visibility_legs(const PolygonGround& ground, bool swept);

}  // namespace outrider
