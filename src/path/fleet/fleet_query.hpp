// A problem of a fleet as planners use it: states, and the distances of all cells from each goal.
#pragma once

#include <limits>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/path/fleet/fleet.hpp"
#include "outrider/search/labels.hpp"

namespace outrider::fleet {

inline constexpr std::uint32_t unreachable = std::numeric_limits<std::uint32_t>::max();

struct Query {
  const GridMap& ground;
  std::vector<State> starts, goals;               // by GridMap::index()
  std::vector<std::vector<std::uint32_t>> steps;  // by robot and state: steps to the goal on the empty grid

  [[nodiscard]] std::size_t robots() const { return starts.size(); }
  /// Calls visit(next) for waiting and the four moves, in an order that is always the same.
  template <class Visit>
  void for_each_step(State s, Visit visit) const {
    visit(s);
    const std::uint8_t moves = ground.moves[s];
    if ((moves & 1U) != 0) visit(s + 1);
    if ((moves & 2U) != 0) visit(s + ground.stride);
    if ((moves & 4U) != 0) visit(s - 1);
    if ((moves & 8U) != 0) visit(s - ground.stride);
  }
};

/// Checks the problem and finds the distances. Faults: those of planners.hpp; cancelled.
/// O(robots * cells).
Outcome<Query> query_of(const FleetProblem& problem, const Budget& budget);

/// The states of one robot, step by step; the last one is its goal.
using Track = std::vector<State>;

/// Makes a plan of tracks. The lower bound is the sum of the distances.
FleetPlan plan_of(const Query& query, const std::vector<Track>& tracks, std::uint64_t expansions);

}  // namespace outrider::fleet
