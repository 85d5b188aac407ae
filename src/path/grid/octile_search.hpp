// The search that Dijkstra and A* share: along the eight moves, f = g + weight * octile distance.
#pragma once

#include <cstdint>

#include "outrider/core/budget.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Plans a path. Weight 0 is Dijkstra, 1 is A*, more is weighted A*. The lower bound is cost / max(1,
/// weight).
Outcome<Plan> octile_search(const Problem& problem, double weight, const Budget& budget,
                            Workspace& workspace);

enum class Heuristic : std::uint8_t { octile, euclidean, chebyshev };

/// Settings that guide A* to the goal.
struct Guide {
  double weight = 1.0;
  Heuristic heuristic = Heuristic::octile;
  bool smallest_g = false;  ///< of equal f the smallest g comes first, not the largest

  /// octile_search() does it.
  [[nodiscard]] bool plain() const { return heuristic == Heuristic::octile && !smallest_g; }
};

/// Plans a path as octile_search() does, led by another heuristic or with another rule for ties.
Outcome<Plan> guided_search(const Problem& problem, const Guide& guide, const Budget& budget,
                            Workspace& workspace);

/// Plans from the start of the problem to each of the goals, in one search of weight 0.
std::vector<Outcome<Plan>> octile_search_many(const Problem& problem, const std::vector<Vec2>& goals,
                                              const Budget& budget, Workspace& workspace);

}  // namespace outrider
