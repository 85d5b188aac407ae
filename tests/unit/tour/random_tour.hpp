// Seeded tour problems: yards, where drives and aims follow from positions, and tables of mere numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/vec.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

/// A yard of 20 x 20 m. A stop serves some of the goals within 9 m, at most `most_served` of them. One
/// drive in four goes round something: longer, and with other headings.
inline TourProblem random_yard(std::size_t goals, std::size_t stops, std::size_t most_served,
                               std::uint64_t seed) {
  Rng rng = Rng(seed).child("yard");
  const auto place = [&] { return Vec2{rng.uniform(-10.0, 10.0), rng.uniform(-10.0, 10.0)}; };
  std::vector<Vec2> at{{0.0, -9.5}};
  std::vector<Vec2> targets;
  for (std::size_t s = 0; s < stops; ++s) at.push_back(place());
  for (std::size_t g = 0; g < goals; ++g) targets.push_back(place());
  TourProblem problem;
  problem.goals = goals;
  problem.heading_rad = pi / 2.0;
  problem.turning = {0.8, 6.0};
  problem.yaw_rate_radps = pi;
  problem.pitch_rate_radps = pi / 6.0;
  problem.services.resize(at.size());
  const auto serve = [&](std::size_t s, std::uint32_t g) {
    const Vec2 line = targets[g] - at[s];
    problem.services[s].push_back(
        {g, heading_of(line), rng.uniform(-0.2, 0.5), 0.2 + norm(line) / rng.uniform(6.0, 9.0)});
  };
  for (std::size_t s = 1; s < at.size(); ++s) {
    const std::size_t most = 1 + static_cast<std::size_t>(rng.below(most_served));
    for (std::uint32_t g = 0; g < goals; ++g) {
      if (problem.services[s].size() < most && distance(targets[g], at[s]) < 9.0 && rng.below(2) == 0)
        serve(s, g);
    }
  }
  for (std::uint32_t g = 0; g < goals; ++g) {
    const auto serves = [&](const auto& here) { return std::ranges::count(here, g, &Service::goal) > 0; };
    if (std::ranges::none_of(problem.services, serves))
      serve(1 + static_cast<std::size_t>(rng.below(stops)), g);
  }
  for (const Vec2 a : at) {
    for (const Vec2 b : at) {
      const double straight = distance(a, b);
      const bool round = rng.below(4) == 0;
      const double length = round ? straight * rng.uniform(1.1, 1.6) : straight;
      const double heading = straight > 0.0 ? heading_of(b - a) : 0.0;
      const double bend = round ? rng.uniform(-1.0, 1.0) : 0.0;
      problem.drives.push_back(
          {duration(length, {0.8, 0.8}) + std::abs(2.0 * bend) / 0.8, heading + bend, heading - bend});
    }
  }
  return problem;
}

/// Numbers that follow from no geometry: no triangle inequality, services at the start, zero times.
inline TourProblem random_table(std::size_t goals, std::size_t stops, std::uint64_t seed) {
  Rng rng = Rng(seed).child("table");
  TourProblem problem;
  problem.goals = goals;
  problem.heading_rad = rng.uniform(-7.0, 7.0);
  problem.turning = {rng.uniform(0.3, 3.0),
                     rng.below(3) == 0 ? std::numeric_limits<double>::infinity() : 2.0};
  problem.yaw_rate_radps = rng.uniform(0.3, 3.0);
  problem.pitch_rate_radps = rng.uniform(0.1, 1.0);
  problem.services.resize(stops + 1);
  const auto serve = [&](std::size_t s, std::uint32_t g) {
    problem.services[s].push_back({g, rng.uniform(-7.0, 7.0), rng.uniform(-0.5, 0.8), rng.uniform(0.0, 2.0)});
  };
  for (std::uint32_t g = 0; g < goals; ++g) {
    const std::size_t surely = 1 + static_cast<std::size_t>(rng.below(stops));
    for (std::size_t s = 0; s <= stops; ++s) {
      if (s == surely || rng.below(s == 0 ? 6 : 2) == 0) serve(s, g);
    }
  }
  for (std::size_t i = 0; i <= stops; ++i) {
    for (std::size_t j = 0; j <= stops; ++j) {
      const double time = rng.below(8) == 0 ? 0.0 : rng.uniform(0.0, 8.0);
      const bool no_way_back = j == 0 && rng.below(2) == 0;
      problem.drives.push_back({no_way_back ? std::numeric_limits<double>::infinity() : time,
                                rng.uniform(-7.0, 7.0), rng.uniform(-7.0, 7.0)});
    }
  }
  return problem;
}

}  // namespace outrider
