// Sampling-based planners, through OMPL: a graph over random free points that improves with each point.
//
//   prm_star   builds a roadmap in which each point is joined to the nearest e (1 + 1/2) log n points that it
//              sees; the roadmap is searched at the end
//   rrt_star   grows a tree from the start and rewires it where a new point shortens a path
//   bit_star   adds points in batches and tries edges in the order of the path length that they promise; once
//              there is a path, it draws points from the ellipse of those that may improve it
//
// The planners accept polygons only. Points and legs are tested exactly by PolygonGround, so legs are never
// sampled. Not complete: after `iterations` draws without a path the fault is budget_exhausted, even if no
// path exists. The cost converges to that of the shortest path with the number of draws, without a guaranteed
// ratio; lower_bound is the straight distance. The path has no arcs.
//
// An expansion is one drawn point. For n points, O(n log n) legs are tested. A trace reports the points that
// are joined to the start at the end, in the order in which legs to them were first tried. Each has its
// parent on the shortest path from the start along the graph, which may have been drawn later, and its
// distance in m. Results are reproducible: all draws come from Rng with `seed`, neighbours are exact, and
// nothing depends on time. A call disables OMPL's messages in this process. Faults: those of polygon_query();
// bad_input for options out of range; budget_exhausted; cancelled. Thread rule: concurrent calls are safe.
//
// They are built only if CMake finds OMPL (OUTRIDER_WITH_OMPL).
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

/// Options of the sampling-based planners.
struct SamplingOptions {
  std::int64_t iterations = 4000;  ///< number of points drawn
  std::int64_t seed = 1;           ///< seed of the points
};
std::vector<Option> describe(SamplingOptions& options);

/// Plan a path as described above.
Outcome<Plan> prm_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace);
Outcome<Plan> rrt_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace);
Outcome<Plan> bit_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace);

/// Adds the three planners to the catalogue. Once, before the first thread starts.
void add_sampling_planners();

}  // namespace outrider
