// Hybrid A*: paths for a robot that steers, among the blocked cells of a grid.
//
// The search goes from pose to pose along short arcs to either side and straight pieces, forwards and, if the
// robot can, backwards. Poses are exact; the search keeps one of those that fall into the same cell of
// `cell_m` and the same of `headings` headings, the first that it expands. From some of the poses, more often
// near the goal, it tries the turning paths of Reeds and Shepp (of Dubins without reversing) that lead
// straight to the goal pose; to a goal without a heading it tries an arc and a tangent. The plan is the
// cheapest path that it met by the time that the goal leaves the queue. It is led by the larger of two
// estimates: the shortest turning path in an empty plane, from a table, and the path to the goal of a point,
// or of the largest disk in the outline, that need not turn, found backwards over the cells as far as it is
// asked.
//
// A start without a heading is tried with many. The path begins and ends exactly at the given points, its
// pieces are arcs of the turning radius and straight pieces, and the outline of the robot touches no blocked
// cell anywhere along it (exact, cell by cell; cells are closed squares, as in the grid model `cells`). The
// cost is the length plus the prices of cusps and of driving backwards. No path of a robot that steers so
// costs less than lower_bound: the larger of the shortest turning path in an empty plane and 0.92 of the way
// over the corners of cells, less a cell; so cost - lower_bound bounds what was missed.
//
// Not complete: a pose may stand for another one in its cell from which there was a way. no_path means that
// not even that point or disk gets there, which is proven; budget_exhausted stands for a search that ended
// without a path, too. A finer cell, more headings and shorter steps find more. Not optimal, for the same
// reason and as its estimates may be too large by a part of the radius.
//
// O(n log n) for n expanded poses, and O(m log m) for the m cells that the way backwards comes to; nothing
// is prepared for a ground, but for a robot with an outline the distances to blocked cells, O(cells) and 8
// bytes each. The workspace keeps all memory, 4 bytes for each entry of the table of turning
// paths (2 MB), and 16 bytes for each cell of the largest grid. A trace has the poses as its states and their
// places. Faults: those of grid_query() and bad_input for a grid of corners, options out of range, an end
// at which the robot touches a blocked cell (start_blocked, goal_blocked); no_path,
// budget_exhausted and cancelled. Thread rule: one workspace per thread. Sources: Dolgov, Thrun, Montemerlo
// and Diebel, Path planning for autonomous vehicles in unknown semi-structured environments, International
// Journal of Robotics Research 29 (2010); Reeds and Shepp (1990); Dubins (1957).
#pragma once

#include <cstdint>

#include "outrider/core/budget.hpp"
#include "outrider/path/steering/steering_options.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of hybrid_a_star(). Lengths of 0 stand for a default that depends on the turning radius.
struct HybridAStarOptions {
  SteeringOptions steering;              ///< the robot
  double cell_m = 0.0;                   ///< side of the cells that keep one pose; 0: a fifth of the radius
  std::int64_t headings = 72;            ///< headings of a cell
  double weight = 1.3;                   ///< weight of the estimate; above 1 the search is faster
  std::int64_t passes = 3;               ///< how often the path is shortened
  std::int64_t most_states = 4'000'000;  ///< poses that the search may hold, 100 bytes each
};
std::vector<Option> describe(HybridAStarOptions& options);

/// Plans a path as described above.
Outcome<Plan> hybrid_a_star(const Problem& problem, const HybridAStarOptions& options, const Budget& budget,
                            Workspace& workspace);

}  // namespace outrider
