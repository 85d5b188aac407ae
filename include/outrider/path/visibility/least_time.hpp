// Fastest paths of a robot that turns in place before each straight leg, if turning takes time.
//
// The time of a path is its length / speed + turn_price * the sum of its turns. The first turn, from the
// initial heading, counts if a heading is given. Stops cost nothing, so many small turns take as long as one
// large turn.
//
// In this model the planner is optimal among all paths of the disk. Cutting a corner makes a path shorter
// without more turning (a polygon inscribed in a curve has at most its length and its total curvature). So
// the fastest path is taut: it turns only where an obstacle lies on its inner side. Taut paths of a disk are
// chains of tangents and of arcs around corners, all in the tangent graph of visibility_graph.hpp. A*
// searches the legs of that graph, because a leg determines the heading. Its consistent heuristic is the time
// for the straight distance plus the turn towards the goal.
//
// lower_bound is the time along the arcs: no path takes less, and no path with turns in place attains it. The
// plan replaces each arc by straight legs that turn by at most s = arc_step each and by the same angle in
// total. Its time is at most tan(s / 2) / (s / 2) times the bound, 1.0026 at 10 degrees; the ratio tends to 1
// as s tends to 0. If a gap is too narrow for such legs, the arc remains (see visibility_graph.hpp).
//
// `cost` and `lower_bound` are in s, and Plan::weights holds the weights. Complete. The graph is that of
// visibility_graph_reduced; it is built at the first query on a ground and kept in the workspace. Memory,
// budget and faults are those of visibility_graph_reduced, plus bad_input for a speed or price out of range.
// Sources: Fenchel's and Milnor's total curvature of inscribed polygons (Milnor, On the total curvature of
// knots, 1950); Liu and Arimoto (1992) for the graph; Hart, Nilsson and Raphael (1968).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of least_time().
struct LeastTimeOptions {
  double speed_mps = 0.8;               ///< speed on straight legs
  double turn_price_s_per_rad = 1.25;   ///< time of turning in place
  bool first_turn = false;              ///< count the turn from `heading_rad` to the first leg
  double heading_rad = 0.0;             ///< initial heading, used if `first_turn` is set
  double arc_step_rad = radians(10.0);  ///< largest turn between the straight legs that replace an arc
};
std::vector<Option> describe(LeastTimeOptions& options);

/// Plans a path as described above.
Outcome<Plan> least_time(const Problem& problem, const LeastTimeOptions& options, const Budget& budget,
                         Workspace& workspace);

/// Plans from the start to each of the goals, like visibility_graph_many().
std::vector<Outcome<Plan>> least_time_many(const Problem& problem, const std::vector<Vec2>& goals,
                                           const LeastTimeOptions& options, const Budget& budget,
                                           Workspace& workspace);

}  // namespace outrider
