// Seeded tours on finite supplies, and their slow twin.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/tour/supply/supply.hpp"
#include "unit/tour/random_tour.hpp"

namespace outrider {

/// A yard whose last one or two stops are stations, at first with supplies without end.
inline SupplyProblem random_supply(std::size_t goals, std::size_t stops, std::uint64_t seed) {
  Rng rng = Rng(seed).child("supply");
  const std::size_t stations = 1 + static_cast<std::size_t>(rng.below(2));
  SupplyProblem problem;
  problem.table = random_yard(goals, stops + stations, 2, seed);
  problem.charge_per_metre = rng.uniform(1.0, 5.0);
  problem.charge_per_second = rng.below(3) == 0 ? 0.0 : rng.uniform(0.2, 3.0);
  problem.charge_per_shot = rng.below(2) == 0 ? 0.0 : rng.uniform(1.0, 5.0);
  for (const Drive& drive : problem.table.drives) problem.lengths_m.push_back(0.7 * drive.time_s);
  const std::uint64_t limited = 1 + rng.below(3);  // water, charge, both
  if ((limited & 1U) != 0) problem.water = static_cast<double>(1 + rng.below(goals));
  if ((limited & 2U) != 0) problem.charge = rng.uniform(60.0, 250.0);
  for (std::size_t s = 0; s < stations; ++s) {
    Store store = s % 2 == 0 ? Store::water : Store::charge;
    if (limited == 1) store = Store::water;
    if (limited == 2) store = Store::charge;
    problem.stations.push_back({stops + 1 + s, store, rng.uniform(0.0, 5.0), rng.uniform(0.0, 0.1)});
  }
  return problem;
}

/// Returns what the steps take, or infinity, without the judge's code for the charge on the way: each prefix
/// is priced.
inline double own_price(const SupplyProblem& problem, const std::vector<SupplyStep>& steps) {
  const auto after = levels(problem, steps);
  return after ? after->back().time_s : std::numeric_limits<double>::infinity();
}

/// The least time over all sequences with at most `chain` fills between two services.
inline double brute_force(const SupplyProblem& problem, std::size_t chain, std::vector<SupplyStep> steps = {},
                          std::uint32_t served = 0, std::size_t fills = 0) {
  if (!steps.empty() && !levels(problem, steps)) return std::numeric_limits<double>::infinity();
  if (served + 1U == 1U << problem.table.goals) return own_price(problem, steps);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t stop = 0; stop < problem.table.services.size(); ++stop) {
    for (const Service& service : problem.table.services[stop]) {
      if ((served >> service.goal & 1U) != 0) continue;
      auto longer = steps;
      longer.push_back({stop, {service.goal}, {}});
      least = std::min(least, brute_force(problem, chain, std::move(longer), served | 1U << service.goal, 0));
    }
  }
  for (std::size_t f = 0; fills < chain && f < problem.stations.size(); ++f) {
    auto longer = steps;
    longer.push_back({problem.stations[f].stop, {}, f});
    least = std::min(least, brute_force(problem, chain, std::move(longer), served, fills + 1));
  }
  return least;
}

}  // namespace outrider
