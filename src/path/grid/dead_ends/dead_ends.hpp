// Dead ends of a grid: parts that no shortest path between two cells outside of them enters.
//
// A gate is a straight run of free cells, along a row or a column, between two blocked cells of one wall: the
// wall and the gate together enclose one side of the gate. The gate itself is the only shortest way between
// two of its cells, so a shortest path that crosses it never comes back. Gates that do not cross each other
// cut the ground into areas, which form a tree with the gates as its edges; there is one tree for each
// connected part of the ground. A shortest path stays in the areas on the way between those of its two ends,
// and in the gates beside them. Everything else is a dead end for this path.
//
// Two blocked cells belong to one wall if a chain of blocked cells that touch, if only at a corner, joins
// them; no path passes between two of those. All walls that reach the border are one. Short gates are chosen
// first. Labels are kept by runs of equal ones along the rows: a quarter of a byte a cell, three bytes a
// run and eight an area. Sources: Pochter et al., Search space reduction using swamp hierarchies (2010), for
// the idea that parts of a map are of use only to their own cells; here they come from the walls alone, in
// one sweep instead of a search.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "grid/row_runs.hpp"
#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

struct DeadEnds {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// An area and the gate to its parent, in 64 bits.
  class Area {
   public:
    static constexpr std::uint32_t most = (1U << 22U) - 1;         ///< areas
    static constexpr std::uint32_t most_length = (1U << 18U) - 1;  ///< cells of a gate

    /// The root of a tree, which has no gate.
    Area() = default;
    /// `first`: index of the lowest cell of the gate, which runs along a row or a column.
    Area(std::uint32_t parent, std::uint32_t first, std::uint32_t length, bool in_row)
        : bits_(std::uint64_t{first} << 41U | std::uint64_t{length} << 23U | std::uint64_t{parent} << 1U |
                (in_row ? 1U : 0U)) {}

    /// Returns none for a root.
    [[nodiscard]] std::uint32_t parent() const {
      const auto number = static_cast<std::uint32_t>(bits_ >> 1U) & most;
      return number == most ? none : number;
    }
    /// Returns the first cell of the gate, counted from the border around the grid.
    [[nodiscard]] Cell low(std::uint32_t row_length) const {
      const auto first = static_cast<std::uint32_t>(bits_ >> 41U);
      return {static_cast<int>(first % row_length), static_cast<int>(first / row_length)};
    }
    [[nodiscard]] Cell high(std::uint32_t row_length) const {
      const auto [x, y] = low(row_length);
      const int more = static_cast<int>(static_cast<std::uint32_t>(bits_ >> 23U) & most_length) - 1;
      return (bits_ & 1U) != 0 ? Cell{x + more, y} : Cell{x, y + more};
    }

   private:
    std::uint64_t bits_ = std::uint64_t{most} << 1U;  // first cell, length, parent, along a row
  };

  std::vector<Area> areas;   ///< parents before their children, the trees one after the other
  std::uint32_t stride = 0;  ///< of the map
  RowRuns runs;              ///< of free cells of equal labels, with the blocked ones after them
  std::vector<std::array<std::uint8_t, 3>> labels;  ///< by run, the low byte first

  std::vector<std::uint32_t> by_cell;  ///< labels in place of runs, after spread()

  /// Keeps the labels cell by cell: four bytes each, found faster.
  void spread(std::size_t cells) {
    std::vector<std::uint32_t> all(cells);
    for (std::uint32_t i = 0; i < cells; ++i) all[i] = label(i);
    by_cell = std::move(all);
    runs = {};
    labels = {};
  }

  /// Returns the label of a free cell by its index of the map: twice the area; for a cell of a gate, twice
  /// the area behind it plus one.
  [[nodiscard]] std::uint32_t label(std::uint32_t index) const {
    if (!by_cell.empty()) return by_cell[index];
    const auto [low, middle, high] = labels[runs.at(index)];
    return std::uint32_t{low} | std::uint32_t{middle} << 8U | std::uint32_t{high} << 16U;
  }
};

/// Finds the dead ends of a map of the model `cells`, of at most 2^22 cells. O(cells + gates log gates): 5 to
/// 10 ns a cell.
DeadEnds dead_ends_of(const GridMap& ground);

}  // namespace outrider
