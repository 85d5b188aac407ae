// Ascent: a lower bound on every tour as a sum of shares, one for each goal, and what the shares leave
// unpaid.
//
// The drives between stops, the aims between the services of a stop and the services themselves are arcs from
// the start to the goals. A tour holds an arborescence over them that reaches each goal: a visit is entered
// by its drive, its first service from the stop, each further one from the one before. So its time is at
// least that of the least such arborescence, a Steiner arborescence, which dual ascent bounds: take a goal
// and the set of places from where it is reached without paying. Each tour enters the set, so the goal's
// share grows by what the cheapest arc into it costs, and every arc into it is paid as much. It goes on until
// the start is in the set. The goal whose set is smallest comes first, so that neighbours grow together.
//
// A first service costs a fee, and the drive to its stop so much less: else every service would be
// a first one. Turns and the first aim of a visit count nothing here. All sums are of whole ticks: exact.
// Source: Wong, A dual ascent approach for Steiner tree problems on a directed graph, Mathematical
// Programming 28, 1984. For one stop it is the least spanning arborescence (Edmonds, 1967).
#pragma once

#include <vector>

#include "instance.hpp"
#include "outrider/core/budget.hpp"

namespace outrider::tour {

struct AscentRules {
  std::vector<std::uint32_t> apart;  ///< goals whose shares pay no drives: they end at the nearest stop
  double most_s = infinity;          ///< of a drive that shares may pay together
};

struct Shares {
  double total = 0.0;  ///< of all goals
  std::vector<float>
      drive_left;  ///< [to * stops + from]: time of the drive that is unpaid, its turn left out
  std::vector<float> serve_left;  ///< node -> what is unpaid of its service and of the cheapest way into it
};

/// Every tour takes at least `total`, and what is left of its drives, of its turns and of its services to the
/// goals apart. O(goals * (share / 0.01 s) * arcs) at worst. One expansion a step; where the budget ends, the
/// shares are those so far.
Shares ascend(const Instance& instance, const AscentRules& rules, BudgetMeter& meter);

}  // namespace outrider::tour
