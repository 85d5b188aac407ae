// Least time for a robot that turns in place before each straight, when turning has a price.
//
// The time of a path is its length / speed + turn_price * the sum of its turns, the first one from the
// heading at the start where that is given. There is no price for halting, so many small turns cost what
// one large turn does.
//
// Optimal among all paths of the disk, in this sense. Cutting a corner short makes a path shorter and turns
// it no more (a polygon inscribed in a curve has at most its length and its total curvature), so the
// fastest path is taut: it turns only where an obstacle lies on its inner side. Taut paths of a disk are
// chains of tangents and arcs about corners, all in the tangent graph of visibility_graph.hpp. A* searches
// that graph by legs, which fix the heading, with the straight distance and the turn towards the goal as
// its consistent estimate. lower_bound is the time along the arcs: no path takes less, and none that turns
// in place attains it. The plan replaces each arc by straight legs that turn by at most arc_step =: s, the
// same angle in all; its time is at most tan(s / 2) / (s / 2) times the bound, 1.0026 at 10 degrees, and
// comes as near as s is small. (Where a gap is too narrow for such legs, as in visibility_graph.hpp, the
// arc stays.)
//
// `cost` and `lower_bound` are in s, Plan::weights holds the prices. Complete. The graph, that of
// visibility_graph_reduced, is built at the first query on a ground and kept in the workspace; memory,
// budget and faults are as there. bad_input on a speed or price out of range.
// Sources: Fenchel's and Milnor's total curvature of inscribed polygons (Milnor, On the total curvature of
// knots, 1950); Liu and Arimoto (1992) for the graph; Hart, Nilsson and Raphael (1968).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct LeastTimeOptions {
  double speed_mps = 0.8;
  double turn_price_s_per_rad = 1.25;
  bool first_turn = false;  ///< whether the turn from `heading_rad` to the first leg counts
  double heading_rad = 0.0;
  double arc_step_rad = radians(10.0);
};
std::vector<Option> describe(LeastTimeOptions& options);

Outcome<Plan> least_time(const Problem& problem, const LeastTimeOptions& options, const Budget& budget,
                         Workspace& workspace);

/// Many goals from one start, as visibility_graph_many().
std::vector<Outcome<Plan>> least_time_many(const Problem& problem, const std::vector<Vec2>& goals,
                                           const LeastTimeOptions& options, const Budget& budget,
                                           Workspace& workspace);

}  // namespace outrider
