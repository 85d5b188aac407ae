// Seeded pursuits on smooth maps: many different costs, and nearly no walls.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/pursuit/problem.hpp"

namespace outrider::testing {

enum class Walk {
  wander,  ///< straight on for 40 s, then anywhere
  round,   ///< along the edge of the map, with a rest in each tenth second
  late,    ///< as wander, but in the first 4/5 of the seconds it rests on a wall
};

struct SmoothPursuit {
  int side = 800;
  int seconds = 6000;
  std::uint32_t least = 1, most = 100;  ///< costs
  Walk walk = Walk::wander;
  std::uint64_t seed = 1;
};

/// Costs between random values on two lattices, 128 and 32 cells wide; in integers, so the same everywhere.
inline CostGrid smooth_costs(const SmoothPursuit& of, Rng& rng) {
  GridFrame frame;
  frame.width = frame.height = of.side;
  CostGrid costs(frame);
  std::vector<std::int64_t> sums(frame.size());
  std::int64_t share = 3;
  for (const int wide : {128, 32}) {
    const int nodes = of.side / wide + 2;
    std::vector<std::int64_t> values;
    for (int i = 0; i < nodes * nodes; ++i) values.push_back(static_cast<std::int64_t>(rng.below(1000)));
    const auto value = [&](int x, int y) { return values[static_cast<std::size_t>(y * nodes + x)]; };
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Cell c = frame.cell(i);
      const int x = c.x / wide, y = c.y / wide, right = c.x % wide, up = c.y % wide;
      sums[i] += share *
                 ((value(x, y) * (wide - right) + value(x + 1, y) * right) * (wide - up) +
                  (value(x, y + 1) * (wide - right) + value(x + 1, y + 1) * right) * up) /
                 (wide * wide);
    }
    share = 1;
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    costs.cells[i] = of.least + static_cast<std::uint32_t>(sums[i] * (of.most - of.least) / 4000);
  return costs;
}

inline PursuitProblem smooth_pursuit(const SmoothPursuit& of) {
  Rng rng = Rng(of.seed).child("smooth pursuit");
  PursuitProblem problem;
  problem.threshold = of.most + 1;
  CostGrid costs = smooth_costs(of, rng);
  const Cell wall{of.side - 1, 0};
  costs[wall] = problem.threshold;
  problem.costs = std::make_shared<const CostGrid>(std::move(costs));
  problem.start = {of.side / 10, of.side / 10};
  const int low = of.side / 20, high = of.side - 1 - low;
  Cell at = of.walk == Walk::round ? Cell{of.side / 2, low} : Cell{4 * of.side / 5, 4 * of.side / 5};
  Cell step{0, 0};
  for (int s = 0; s < of.seconds; ++s) {
    if (of.walk == Walk::late && s < of.seconds / 5 * 4) {
      problem.target.push_back(wall);
      continue;
    }
    problem.target.push_back(at);
    if (of.walk != Walk::round && s % 40 == 0)
      step = {static_cast<int>(rng.below(3)) - 1, static_cast<int>(rng.below(3)) - 1};
    if (of.walk == Walk::round) {
      if (at.y <= low) step = {1, 0};
      if (at.x >= high) step = {0, 1};
      if (at.y >= high) step = {-1, 0};
      if (at.x <= low && at.y > low) step = {0, -1};
      if (at.x >= high && at.y >= high) step = {-1, 0};
      if (s % 10 == 0) continue;
    }
    at = {std::clamp(at.x + step.x, 0, of.side - 1), std::clamp(at.y + step.y, 0, of.side - 1)};
  }
  return problem;
}

}  // namespace outrider::testing
