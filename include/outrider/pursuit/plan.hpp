// PursuitPlan: what a pursuit planner answers, where the robot is in each second until the catch.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/pursuit/problem.hpp"

namespace outrider {

/// Work done, in numbers that repeat exactly.
struct PursuitCounters {
  std::uint64_t expansions = 0;  ///< cells and labels taken up, over all searches
  std::uint64_t labels = 0;      ///< (cell, cost, time) labels made by the search in time
  friend bool operator==(const PursuitCounters&, const PursuitCounters&) = default;
};

struct PursuitPlan {
  std::vector<Cell> path;         ///< cell at start_s, start_s + 1, ..., catch_time_s
  int catch_time_s = 0;           ///< the second of the catch
  std::uint64_t cost = 0;         ///< paid from start_s to the catch
  std::uint64_t lower_bound = 0;  ///< proven: no catch costs less
  int earliest_catch_s = 0;       ///< the first second in which a catch is possible; -1 when not known
  PursuitCounters counters;

  [[nodiscard]] bool optimal() const { return cost == lower_bound; }
  friend bool operator==(const PursuitPlan&, const PursuitPlan&) = default;
};

}  // namespace outrider
