// sweep() solves the problem by dynamic programming over every cell in every second, for checks and
// comparisons.
//
// The least cost of being in a cell at second t + 1 is the minimum of (cost at t + cost of the cell) over the
// cell itself and its neighbours. Only two layers are stored, so there is no path. Takes O(cells seconds)
// time and 16 bytes per cell. Faults: those of check(problem); no_path; budget_exhausted (an expansion is a
// row of cells in one second); cancelled.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/pursuit/problem.hpp"

namespace outrider {

/// The cheapest catch without its path.
struct LeastCatch {
  std::uint64_t cost = 0;    ///< cost of the cheapest catch
  int catch_time_s = 0;      ///< the earliest second of a catch at that cost
  int earliest_catch_s = 0;  ///< the earliest second of any catch
};

/// Returns the cheapest and the earliest catch.
Outcome<LeastCatch> sweep(const PursuitProblem& problem, const Budget& budget);

}  // namespace outrider
