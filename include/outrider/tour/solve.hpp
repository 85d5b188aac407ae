// Solves the tour problem: exactly for few goals, very well for many, with a lower bound always.
//
// A ruin-and-recreate search with simulated annealing gives a tour. Up to `exact_goals` goals, an A*
// over (goals served, stop, heading, gun) then finds and proves the optimum. Beyond, or where that
// search runs out of expansions, relaxed sweeps and an exact one prove that no tour is faster by more than
// `gap`, or find one; where they run out of work, and beyond 40 goals, the tour stands beside the best bound
// that they, or shares of the goals by dual ascent, reached.
// docs/tour.md tells the methods.
//
// Guarantees: the tour serves every goal (see check() in problem.hpp). The lower bound holds for every
// tour of the given stops, services and drives. proven_optimal: no such tour is faster by more than
// 1e-6 s. Same problem and options, same tour, unless the budget has a wall time or is cancelled.
// Errors: bad_input; no_path when no stop that can be reached serves some goal; budget_exhausted or
// cancelled when nothing could be started. Once there is a tour it is returned, with ended_early set.
// Budget: counts iterations of the search, labels of the exact searches, sets of the sweeps and steps of the
// ascents alike.
// Thread rule: pure function.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

struct TourOptions {
  std::int64_t exact_goals = 12;
  std::int64_t expansions = 1'000'000;
  std::int64_t iterations = 16'000;
  double gap = 0.02;
  std::int64_t operations = 400'000'000;
  std::int64_t seed = 1;
};

std::vector<Option> describe(TourOptions& options);

Outcome<Tour> solve(const TourProblem& problem, const TourOptions& options, const Budget& budget);

/// The same from `begun`, a tour that check() accepts, and never ends worse.
Outcome<Tour> solve_from(const TourProblem& problem, const Tour& begun, const TourOptions& options,
                         const Budget& budget);

}  // namespace outrider
