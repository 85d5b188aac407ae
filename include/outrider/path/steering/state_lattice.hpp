// State lattice: the cheapest path of a robot that steers among those made of a fixed set of motions.
//
// States are the centres of the cells of the grid with one of `headings` headings that point from a centre to
// another one (of 16: along the axes, the diagonals, and two cells ahead and one aside). The motions from a
// heading are the straight line to the next centre ahead, and an arc with a straight piece before or after
// it, to a heading up to 90 degrees away: for each of these the `turns` shortest that end at a centre, are no
// tighter than the turning radius, and are no longer form of one another. They are generated, with the cells
// that the robot touches on them, and so checked exactly. Driven from their end they are the
// motions backwards.
//
// Start and goal move to the centre of their cell and to the nearest heading, at most 14 degrees with 16.
// Ends without a heading take any. The cost is the length plus the prices of cusps and of driving backwards.
//
// Complete and, with weight 1, optimal on the lattice: lower_bound is the cost, a bound for its paths, not
// for those of any robot. With a larger weight the path costs at most so many times as much. no_path means
// that not even a point gets there, which is proven; budget_exhausted stands for a goal that the lattice does
// not reach, too.
//
// A* with the larger of two lower bounds: the shortest turning path in an empty plane, near the goal, and the
// way of a point (corner_distances.hpp); states are opened again where a better way comes late, as the bounds
// are admissible, not consistent. O(n log n) for n states, of 100 bytes. The motions stay in the workspace. A
// trace has the states, and where they are as its places. Faults: as hybrid_a_star(); bad_input for a radius
// of more than 200 cells. Thread rule: one workspace per thread. Sources: Pivtoraiko, Knepper and Kelly,
// Differentially constrained mobile robot motion planning in state lattices, Journal of Field Robotics 26
// (2009).
#pragma once

#include <cstdint>

#include "outrider/core/budget.hpp"
#include "outrider/path/steering/steering_options.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of state_lattice().
struct StateLatticeOptions {
  SteeringOptions steering;              ///< the robot
  std::int64_t headings = 16;            ///< 8, 16 or 32
  std::int64_t turns = 2;                ///< motions to each other heading, the shortest first
  double weight = 1.0;                   ///< weight of the estimate; above 1 the search is faster
  std::int64_t most_states = 8'000'000;  ///< states that the search may hold, 100 bytes each
};
std::vector<Option> describe(StateLatticeOptions& options);

/// Plans a path as described above.
Outcome<Plan> state_lattice(const Problem& problem, const StateLatticeOptions& options, const Budget& budget,
                            Workspace& workspace);

}  // namespace outrider
