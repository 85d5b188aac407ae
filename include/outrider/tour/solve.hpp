// Solves the tour problem: exactly for few goals, heuristically for many, and always with a lower bound.
//
// A ruin-and-recreate search with simulated annealing gives a first tour. Up to `exact_goals` goals, an A*
// search over (goals served, stop, heading, gun) then finds and proves the optimum. For more goals, or if A*
// runs out of expansions, relaxed sweeps and an exact one prove that no tour is faster by more than `gap`, or
// find such a tour. If they run out of operations, or for more than 40 goals, the result is the best tour
// found, with the best lower bound of the sweeps or of a dual ascent over the goals. docs/tour.md describes
// the methods.
//
// Guarantees: the tour serves every goal (see check() in problem.hpp). The lower bound holds for every
// tour over the given stops, services and drives. If proven_optimal is set, no such tour is faster by more
// than 1e-6 s. The same problem and options give the same tour, unless the budget has a wall time or is
// cancelled. Faults: bad_input; no_path if a goal is not served from any reachable stop; budget_exhausted or
// cancelled if the search ended before the first tour. After that, the best tour is returned with ended_early
// set. Budget: iterations of the search, labels of the exact searches, sets of the sweeps and steps of the
// ascents each count as one expansion. Complexity of the search for g goals that a few stops serve each: a
// first tour, then in each iteration O(g) insertions of each of at most 12 goals; a tour that is the best so
// far is polished, in rounds of O(g^3). Thread rule: pure function.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

/// Options of the solver.
struct TourOptions {
  std::int64_t exact_goals = 12;        ///< largest number of goals for which A* proves the optimum
  std::int64_t expansions = 1'000'000;  ///< maximum number of labels that A* expands
  std::int64_t iterations = 16'000;  ///< iterations of ruin and recreate; 1/8 of them before an exact search
  double gap = 0.02;                 ///< optimality gap to prove; 0: prove the optimum, 1: prove nothing
  std::int64_t operations = 400'000'000;  ///< maximum number of drives and visits tried for the lower bound
  std::int64_t seed = 1;                  ///< seed of the search
};

std::vector<Option> describe(TourOptions& options);

/// Receives the visits and the cost of each tour that ruin and recreate finds, of each call the better ones
/// only. It is called on the thread that solves, and changes nothing in the result.
using TourObserver = std::function<void(const std::vector<Visit>& visits, double cost_s)>;

/// Solves the problem as described above.
Outcome<Tour> solve(const TourProblem& problem, const TourOptions& options, const Budget& budget,
                    const TourObserver& found = {});

/// Solves the problem with `begun` as the first tour; check() must accept it. The result is never worse than
/// `begun`.
Outcome<Tour> solve_from(const TourProblem& problem, const Tour& begun, const TourOptions& options,
                         const Budget& budget, const TourObserver& found = {});

}  // namespace outrider
