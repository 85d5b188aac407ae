// Sampling planners through OMPL: a graph over random free points, better with each.
//
//   prm_star   a roadmap: each point is joined to its e (1 + 1/2) log n nearest that it sees, searched at
//              the end
//   rrt_star   a tree from the start, rewired where a new point shortens the way
//   bit_star   batches of points, in which the edges are tried in the order of the length that they
//              promise; once there is a path, points come from the ellipse of those that may improve it
//
// Polygons only. Whether a point or a leg is free for the disk is asked of PolygonGround, exactly, so a
// leg is never sampled. Not complete: after `iterations` draws without a path the fault is
// budget_exhausted, also where there is none. The cost falls towards that of the shortest path with the
// number of draws, without a ratio; lower_bound is the straight distance. The path has no arcs.
//
// An expansion is a point drawn. For n of them O(n log n) legs are tested. A trace tells the points that are
// joined to the start in the end, in the order in which legs to them were first tried, each with its parent
// on the shortest way from the start along the graph (which may have come later), in m. Repeats exactly: all
// draws come from Rng with `seed`, neighbours are exact, and nothing is timed. A call silences OMPL's
// messages in this process. Faults: those of polygon_query(); bad_input on options out of range;
// budget_exhausted; cancelled. Thread rule: any number at once.
//
// Built only where CMake found OMPL (OUTRIDER_WITH_OMPL); find_path_planner("rrt_star") tells.
// Sources: Karaman and Frazzoli, Sampling-based algorithms for optimal motion planning (2011); Gammell,
// Srinivasa and Barfoot, Batch informed trees (2015); Sucan, Moll and Kavraki, The Open Motion Planning
// Library (2012).
#pragma once

#include <cstdint>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct SamplingOptions {
  std::int64_t iterations = 4000;
  std::int64_t seed = 1;
};
std::vector<Option> describe(SamplingOptions& options);

Outcome<Plan> prm_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace);
Outcome<Plan> rrt_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace);
Outcome<Plan> bit_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace);

}  // namespace outrider
