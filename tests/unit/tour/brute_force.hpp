// The slow twin: every sequence of (stop, goal), priced by cost().
#pragma once

#include <vector>

#include "outrider/tour/problem.hpp"

namespace outrider {

/// Least cost over all tours whose visits each serve a goal. Exponential: a handful of goals.
inline double brute_force(const TourProblem& problem, std::vector<Visit> visits = {},
                          std::uint32_t served = 0) {
  if (served + 1U == 1U << problem.goals) return cost(problem, visits);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t stop = 0; stop < problem.services.size(); ++stop) {
    for (const Service& service : problem.services[stop]) {
      if ((served >> service.goal & 1U) != 0) continue;
      std::vector<Visit> longer = visits;
      if (longer.empty() || longer.back().stop != stop) longer.push_back({stop, {}});
      longer.back().goals.push_back(service.goal);
      least = std::min(least, brute_force(problem, std::move(longer), served | 1U << service.goal));
    }
  }
  return least;
}

}  // namespace outrider
