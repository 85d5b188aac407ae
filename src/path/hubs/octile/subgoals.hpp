// Subgoals: the cells at which a shortest path along the eight moves has to turn.
//
// A subgoal is a free cell at a convex corner: a diagonal neighbour is blocked, and the two cells beside both
// are free. Of the shortest paths between two cells, one goes diagonally first wherever it can. It consists
// of legs, each of which is a diagonal run and then a straight one, and it turns from one leg to the next
// only at subgoals (those are the turns that jump point search calls forced). So a cell needs legs only to
// the first subgoals on its runs. Thread rule: read-only after construction.
// Sources: Uras, Koenig and Hernandez, Subgoal graphs for optimal pathfinding in eight-neighbor grids (2013);
// Harabor and Grastien, Online graph pruning for pathfinding on grid maps (2011).
#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "hubs/turns/turn_graph.hpp"

namespace outrider::hub_labelling {

/// Longest side of a grid whose runs fit.
inline constexpr int longest_side_of_runs = 32767;

/// The lengths of runs, to tell whether a leg is free. 8 bytes per cell.
struct OctileRuns {
  /// For each index of the map, the number of legal moves to the east, north, north-east and north-west.
  std::vector<std::array<std::int16_t, 4>> free;
  std::uint32_t stride = 0;  ///< that of the map

  /// Returns true if the leg from a to b is legal: a diagonal run and then a straight one.
  [[nodiscard]] bool leg(Cell a, Cell b) const;

 private:
  [[nodiscard]] int moves(Cell from, std::size_t direction) const {
    return free[static_cast<std::size_t>(from.y + 1) * stride + static_cast<std::size_t>(from.x + 1)]
               [direction];
  }
};
OctileRuns octile_runs(const GridMap& ground, const std::stop_token& stop = {});

/// Returns the cell at which the leg from a to b, diagonal first, becomes straight.
inline Cell bend_of(Cell a, Cell b) {
  const int dx = b.x - a.x, dy = b.y - a.y, steps = std::min(std::abs(dx), std::abs(dy));
  return {a.x + (dx > 0 ? steps : -steps), a.y + (dy > 0 ? steps : -steps)};
}

struct Subgoals {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  std::vector<Cell> cells;            ///< in the order of GridMap::index()
  std::vector<std::uint32_t> number;  ///< by index of the map: index of `cells`, or none
  /// For each index of the map and straight move, the number of moves to the next subgoal; 0 if a blocked
  /// cell comes first.
  std::vector<std::array<std::int16_t, 4>> ahead;
};
Subgoals subgoals_of(const GridMap& ground, const std::stop_token& stop = {});

/// Finds subgoals on the legs from a cell: the first ones, but of two of them mostly only the nearer one
/// where a shortest path to the other leads over it. O(diagonal moves from the cell). Thread rule: one
/// instance per thread.
class SubgoalReach {
 public:
  SubgoalReach(const GridMap& ground, const OctileRuns& runs, const Subgoals& subgoals)
      : ground_(ground), runs_(runs), subgoals_(subgoals) {}

  /// Returns their indices in `cells`, without the cell itself; valid until the next call.
  const std::vector<std::uint32_t>& from(Cell cell);

 private:
  [[nodiscard]] std::uint32_t ahead(std::size_t vertex, unsigned move) const;
  void diagonal(std::size_t vertex, unsigned move, std::uint32_t last_level, std::uint32_t last_upright);
  void find(std::uint32_t subgoal, std::uint32_t last);
  [[nodiscard]] bool leads_over(std::uint32_t subgoal, std::uint32_t between) const;

  const GridMap& ground_;
  const OctileRuns& runs_;
  const Subgoals& subgoals_;
  Cell cell_;
  std::vector<std::uint32_t> found_;
};

/// Joins each subgoal to those that SubgoalReach finds; a path may go on from one edge to any other. Returns
/// nothing if there would be more than `most_edges`, or if `stop` is requested. In parallel.
std::optional<TurnGraph> subgoal_graph(const GridMap& ground, const OctileRuns& runs,
                                       const Subgoals& subgoals, std::size_t most_edges,
                                       const std::stop_token& stop);

}  // namespace outrider::hub_labelling
