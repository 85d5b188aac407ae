// Stops: selects the few cells from which a tour is made, out of all cells from which a target can be hit.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {

/// Least hit rate of a shot that is planned while there is a choice.
inline constexpr double good_rate = 0.85;

/// A robot this near to a stop stands at it.
inline constexpr double there_m = 1e-6;

/// Returns the cells from which a target can be hit despite errors, ascending. The shot tolerates the errors
/// of the gun, the robot fits at every place within the position error of a drive, and the target can also be
/// hit from all cells whose centres lie within that error. If no cell meets these conditions, all cells from
/// which the target can be hit at all. O(cells of the region).
std::vector<std::size_t> sure_cells(const GuardProblem& problem, const FiringMap& firing_map,
                                    std::size_t target);

/// For each cell, the targets that have it among their sure_cells(). Takes 8 bytes a cell and 4 a hit.
class SureHits {
 public:
  /// `cells_of`: by target, the cells from which it can be hit.
  SureHits(std::size_t cells, const std::vector<std::vector<std::uint32_t>>& cells_of);

  /// Returns the targets of a cell, ascending.
  [[nodiscard]] std::span<const std::uint32_t> at(std::size_t cell) const {
    return {targets_.data() + first_[cell], targets_.data() + first_[cell + 1]};
  }
  /// O(log of the targets of the cell).
  [[nodiscard]] bool has(std::size_t cell, std::size_t target) const;
  /// O(cells + hits).
  void add(std::size_t cell, std::size_t target);

 private:
  std::vector<std::size_t> first_;      // cell -> its first target; one more at the end
  std::vector<std::uint32_t> targets_;  // cell by cell
};

/// Returns the targets that have a firing region, ascending.
std::vector<std::size_t> targets_with_region(const FiringMap& firing_map);

/// Computes the sure hits of all cells at these targets, and at no others.
SureHits sure_hits(const GuardProblem& problem, const FiringMap& firing_map,
                   const std::vector<std::size_t>& targets);

/// Selects at most `most` cells and returns their indices in ascending order. The yard is divided into square
/// tiles. In each tile, the best cell is taken for each maximal set of targets that can be hit from one cell.
/// Tiles have sides of at least `tile_m`; they grow until at most `most` cells are left. If a single tile
/// still has more, greedy set covers are taken from it, one after another, until there are `most`. Only cells
/// within `near_m` of one of the points `around` are candidates, unless `around` is empty. Each target that a
/// candidate can hit can be hit from a selected cell.
std::vector<std::size_t> choose_stops(const FiringMap& firing_map, const SureHits& hits, double tile_m,
                                      std::size_t most, const std::vector<Vec2>& around, double near_m);

/// Returns the place of the cell nearest to `here` among those at least `apart_m` away.
std::optional<Vec2> nearest_place(const FiringMap& firing_map, const std::vector<std::size_t>& cells,
                                  Vec2 here, double apart_m);

}  // namespace outrider
