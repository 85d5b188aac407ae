// PursuitPlan: the answer of a pursuit planner, with the robot's cell in each second until the catch.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/pursuit/problem.hpp"

namespace outrider {

/// Counts of the work of a planner. They are the same in every run.
struct PursuitCounters {
  std::uint64_t expansions = 0;  ///< cells and labels expanded, over all searches
  std::uint64_t labels = 0;      ///< (cell, cost, time) labels created by the search in time
  friend bool operator==(const PursuitCounters&, const PursuitCounters&) = default;
};

/// A plan of a catch.
struct PursuitPlan {
  std::vector<Cell> path;         ///< cell at start_s, start_s + 1, ..., catch_time_s
  int catch_time_s = 0;           ///< the second of the catch
  std::uint64_t cost = 0;         ///< cost paid from start_s to the catch
  std::uint64_t lower_bound = 0;  ///< proven: no catch costs less
  int earliest_catch_s = 0;       ///< the first second in which a catch is possible; -1: unknown
  PursuitCounters counters;

  /// Returns true if the plan is proven to be the cheapest.
  [[nodiscard]] bool optimal() const { return cost == lower_bound; }
  friend bool operator==(const PursuitPlan&, const PursuitPlan&) = default;
};

}  // namespace outrider
