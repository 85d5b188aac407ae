// Small seeded pursuits, and the slow answer to them: every cell in every second.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/pursuit/problem.hpp"

namespace outrider::testing {

struct SlowCatch {
  std::uint64_t cost = 0;
  int earliest_s = 0;
};

/// Least cost and earliest second of a catch; nothing when there is none. From the definition: whoever
/// is in a cell may go on to each cell not farther than one away.
inline std::optional<SlowCatch> slow_catch(const PursuitProblem& problem) {
  const CostGrid& costs = *problem.costs;
  using Paid = std::optional<std::uint64_t>;
  Grid<Paid> paid(costs.frame);
  paid[problem.start] = 0;
  std::optional<SlowCatch> best;
  for (int s = problem.start_s + 1; s <= problem.last_s(); ++s) {
    Grid<Paid> next(costs.frame);
    for (std::size_t i = 0; i < paid.cells.size(); ++i) {
      if (!paid.cells[i]) continue;
      const Cell from = costs.frame.cell(i);
      for (int k = 0; k < 9; ++k) {
        const Cell to{from.x + k % 3 - 1, from.y + k / 3 - 1};
        if (!costs.contains(to) || problem.wall(to)) continue;
        const std::uint64_t cost = *paid.cells[i] + costs[from];
        next[to] = next[to] ? std::min(*next[to], cost) : cost;
      }
    }
    paid = next;
    const Paid here = paid[problem.target[static_cast<std::size_t>(s)]];
    if (!here) continue;
    if (!best) best = SlowCatch{*here, s};
    best->cost = std::min(best->cost, *here);
  }
  return best;
}

/// Up to `most_side` cells a side and `most_seconds` seconds. Few or many kinds of costs, also none and
/// huge ones and some at the threshold; a target that walks, jumps, rests, or goes over walls. The robot
/// starts on a free cell, at times together with the target.
inline PursuitProblem random_pursuit(Rng& rng, int most_side, int most_seconds) {
  const auto below = [&](int count) {
    return static_cast<int>(rng.below(static_cast<std::uint64_t>(count)));
  };
  GridFrame frame;
  frame.width = 1 + below(most_side);
  frame.height = 1 + below(most_side);
  CostGrid costs(frame);
  PursuitProblem problem;
  const std::uint32_t scale = std::vector<std::uint32_t>{1, 2, 5, 30, 4'000'000'000U}[rng.below(5)];
  problem.threshold = 1 + (scale > 1 ? static_cast<std::uint32_t>(rng.below(scale)) : 0);
  const double walls = rng.uniform(0.0, 0.5), rare = rng.uniform();
  for (std::uint32_t& cost : costs.cells) {
    cost = rng.uniform() < walls ? problem.threshold + static_cast<std::uint32_t>(rng.below(2))
                                 : static_cast<std::uint32_t>(rng.below(problem.threshold));
    if (cost < problem.threshold && rng.uniform() < rare) cost = problem.threshold - 1;
  }
  const auto anywhere = [&] { return Cell{below(frame.width), below(frame.height)}; };
  problem.start = anywhere();
  costs[problem.start] = std::min(costs[problem.start], problem.threshold - 1);
  Cell at = rng.below(8) == 0 ? problem.start : anywhere();
  const std::uint64_t action = rng.below(3);
  const int seconds = 1 + below(most_seconds);
  for (int s = 0; s < seconds; ++s) {
    problem.target.push_back(at);
    if (action == 0) continue;  // rests
    if (action == 1 || rng.below(10) > 0) {
      at = {std::clamp(at.x + below(3) - 1, 0, frame.width - 1),
            std::clamp(at.y + below(3) - 1, 0, frame.height - 1)};
    } else {
      at = anywhere();
    }
  }
  problem.start_s = rng.below(4) == 0 ? below(seconds) : 0;
  problem.costs = std::make_shared<const CostGrid>(std::move(costs));
  return problem;
}

/// A map as it looks on the page: first row on top, digits are costs, '#' is a wall (threshold 10).
inline PursuitProblem drawn_pursuit(const std::vector<std::string>& rows, Cell start,
                                    std::vector<Cell> target) {
  GridFrame frame;
  frame.width = static_cast<int>(rows.front().size());
  frame.height = static_cast<int>(rows.size());
  CostGrid costs(frame);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const char c = rows[static_cast<std::size_t>(frame.height - 1 - y)][static_cast<std::size_t>(x)];
      costs[{x, y}] = c == '#' ? 10U : static_cast<std::uint32_t>(c - '0');
    }
  }
  PursuitProblem problem;
  problem.costs = std::make_shared<const CostGrid>(std::move(costs));
  problem.threshold = 10;
  problem.start = start;
  problem.target = std::move(target);
  return problem;
}

}  // namespace outrider::testing
