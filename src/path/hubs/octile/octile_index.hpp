// The index of the shortest paths along the eight moves: hub labels of all cells, or where these do not fit,
// the subgoals with landmarks.
//
// Thread rule: read-only after construction.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <tuple>
#include <vector>

#include "grid/octile.hpp"
#include "hubs/hub_index.hpp"
#include "hubs/hub_kept.hpp"
#include "hubs/index_bytes.hpp"
#include "hubs/turns/guided_search.hpp"
#include "octile_lists.hpp"

namespace outrider::hub_labelling {

/// Lengths along the moves, exact. Equal paths have equal lengths, and the same holds for sums of a length
/// and a bound.
struct OctileMetric {
  struct Cost {
    Octile moves;  ///< negative parts in a difference
    double cells = 0.0;
    friend bool operator<(const Cost& a, const Cost& b) { return a.cells < b.cells; }
  };
  struct Stored {
    std::uint16_t straight = 0xFFFF, diagonal = 0xFFFF;
  };
  static Cost of(Octile moves) { return {moves, moves.value()}; }
  static Cost between(Cell a, Cell b) { return of(octile_distance(a, b)); }
  static Cost add(const Cost& cost, const Cost& leg) { return of(cost.moves + leg.moves); }
  static double cells(const Cost& cost) { return cost.cells; }
  static Cost far() { return {{}, std::numeric_limits<double>::infinity()}; }
  static Stored none() { return {}; }
  /// Lengths of too many moves are not kept.
  static Stored stored(const Cost& cost) {
    const auto [straight, diagonal] = cost.moves;
    if (straight >= 0xFFFF || diagonal >= 0xFFFF) return none();
    return {static_cast<std::uint16_t>(straight), static_cast<std::uint16_t>(diagonal)};
  }
  static bool known(Stored stored) { return stored.straight != 0xFFFF; }
  static Cost length(Stored stored) { return of({stored.straight, stored.diagonal}); }
  static Cost lead(const Cost& a, const Cost& b) {
    const auto& [large, small] = a < b ? std::tie(b, a) : std::tie(a, b);
    return of({large.moves.straight - small.moves.straight, large.moves.diagonal - small.moves.diagonal});
  }
};

/// The subgoals with landmarks, and what tells which of them a cell reaches.
struct OctileSubgoals {
  Subgoals subgoals;
  GuidedGraph<OctileMetric> graph;
};

/// The index, as hub_memory.hpp asks for it.
struct OctileIndex {
  static constexpr std::string_view planner = "octile_labels";
  OctileRuns runs;
  std::optional<OctileLists> labels;
  std::unique_ptr<const OctileSubgoals> subgoals;  ///< where there are no labels
  std::uint64_t work = 0;
  std::uint64_t work_of_search = 0;

  struct Scratch {
    std::optional<SubgoalReach> reach;
    GuidedMemory<OctileMetric> search;
  };

  /// Builds the index. Returns nothing if it does not fit, or if `stop` is requested. With `try_labels` false
  /// it is one of landmarks on any ground.
  static std::unique_ptr<const OctileIndex> of(const GridMap& ground, std::size_t most_bytes,
                                               const std::stop_token& stop, bool try_labels = true);
  void write(IndexWriter& writer) const;
  /// Returns nothing if the content contradicts itself or the ground.
  static std::unique_ptr<const OctileIndex> read(IndexReader& reader, const GridMap& ground);

  bool straight(const GridMap& /*ground*/, Cell start, Cell goal, std::vector<Cell>& way) const {
    if (!runs.leg(start, goal)) return false;
    way.push_back(bend_of(start, goal));
    way.push_back(goal);
    return true;
  }
  static bool straight_on(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way);
  Found find(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way, Scratch& scratch,
             BudgetMeter& meter) const;

  static Octile moves_of(const std::vector<Cell>& way) {
    Octile moves;
    for (std::size_t i = 1; i < way.size(); ++i) moves = moves + octile_distance(way[i - 1], way[i]);
    return moves;
  }
  static double length_of(const std::vector<Cell>& way) { return moves_of(way).value(); }
  static bool none_shorter(std::span<const CellBox> boxes, const std::vector<Cell>& way) {
    return none_shorter_over(boxes, way.front(), way.back(), moves_of(way));
  }
};

/// Adds the shortest path over a hub to `way`; returns false if there is none. O(labels + legs).
bool find_in(const OctileLists& labels, Cell start, Cell goal, std::vector<Cell>& way);

}  // namespace outrider::hub_labelling
