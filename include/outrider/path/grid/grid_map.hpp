// GridMap: the ground as a grid of free and blocked cells, prepared for searching.
//
// Two models define which paths are legal. Everything outside the grid is blocked.
//   cells    Vertices are the centres of free cells. A leg is legal if it touches no blocked cell (a closed
//            square). So a diagonal move needs both cells beside it (the rule of the MovingAI benchmarks).
//   corners  Vertices are the corners of cells. A leg is legal if it stays out of the interior of the union
//            of the blocked cells: it may run along the border of a blocked cell, but not between two blocked
//            cells that share a side. It may not pass through a pinch, a corner at which two blocked cells
//            meet only diagonally; a path may start or end there.
// In both models, every point of a legal leg lies in a closed free cell. Vertices and cells are counted from
// the lowest corner; the vertex (x, y) of `corners` is the lowest corner of the cell (x, y). Construction
// takes O(cells) and two bytes per cell. Thread rule: read-only after construction. A changed map is a new
// GridMap, made by with(); planners update what they keep in the workspace by comparing the two maps.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

enum class GridModel : std::uint8_t { cells, corners };
std::string_view to_string(GridModel model);

/// Largest accepted number of cells, and of cells per side.
inline constexpr std::size_t most_grid_cells = std::size_t{1} << 28U;
inline constexpr int most_grid_side = 1 << 20U;

/// Checks a frame. Fault: bad_input if it has no cells, too many cells, or numbers that are not finite.
Status check_frame(const GridFrame& frame);

/// The eight moves, straight ones first. Bit i of the move mask of a vertex stands for grid_moves[i].
inline constexpr std::array<Cell, 8> grid_moves = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// A rectangle of cells that become blocked or free.
struct CellChange {
  Cell low;  ///< cell with the least x and y
  int width = 1;
  int height = 1;
  bool blocked = true;
};

/// A grid as described above.
struct GridMap {
  GridFrame frame;  ///< frame of the cells
  GridModel model = GridModel::cells;
  std::uint32_t stride = 0;         ///< length of a row in the arrays, which have a border of one cell
  std::vector<std::uint8_t> marks;  ///< by index(): the bits defined below
  std::vector<std::uint8_t> moves;  ///< by index(): mask of the grid_moves that are legal from that vertex

  static constexpr std::uint8_t blocked_bit = 1;  ///< the cell is blocked
  static constexpr std::uint8_t place_bit = 2;    ///< a path may start or end at the vertex
  static constexpr std::uint8_t pinch_bit = 4;    ///< the vertex is a pinch: a path may not pass through it

  /// Makes a map; cells other than 0 are blocked. Fault: bad_input for a frame that check_frame() refuses, or
  /// if the number of cells does not match the frame.
  static Outcome<GridMap> of(const Grid<std::uint8_t>& blocked, GridModel model);

  /// Returns a copy with the changes applied one after the other; it equals a map made from scratch. Copies
  /// the map, then O(1) for each cell of a change. Fault: bad_input for a rectangle that is empty or leaves
  /// the grid.
  [[nodiscard]] Outcome<GridMap> with(const std::vector<CellChange>& changes) const;

  /// Returns the index of a cell or of a vertex; both may lie one step outside the grid.
  [[nodiscard]] std::uint32_t index(Cell c) const {
    return static_cast<std::uint32_t>(c.y + 1) * stride + static_cast<std::uint32_t>(c.x + 1);
  }
  [[nodiscard]] Cell at(std::uint32_t index) const {
    return {static_cast<int>(index % stride) - 1, static_cast<int>(index / stride) - 1};
  }
  /// Returns true if the cell is blocked or outside the grid.
  [[nodiscard]] bool blocked(Cell c) const {
    return !frame.contains(c) || (marks[index(c)] & blocked_bit) != 0;
  }
  /// Returns true if v is a vertex of the grid.
  [[nodiscard]] bool contains(Cell v) const {
    const int more = model == GridModel::corners ? 1 : 0;
    return v.x >= 0 && v.y >= 0 && v.x < frame.width + more && v.y < frame.height + more;
  }
  /// Returns true if a path may start or end at v.
  [[nodiscard]] bool place(Cell v) const { return contains(v) && (marks[index(v)] & place_bit) != 0; }
  [[nodiscard]] bool pinch(Cell v) const { return contains(v) && (marks[index(v)] & pinch_bit) != 0; }
  /// Returns the position of a vertex, m.
  [[nodiscard]] Vec2 point(Cell v) const {
    return model == GridModel::cells ? frame.centre(v) : frame.corner(v);
  }
  /// Returns the vertex of a point: that of the cell that contains it, or the nearest corner. Returns nothing
  /// outside the grid.
  [[nodiscard]] std::optional<Cell> vertex_at(Vec2 p) const;
};

/// Returns the cells that are blocked in one map and free in the other, row by row. Returns nothing if their
/// frames or models differ, or if more than `most` cells differ. One pass over the marks: 0.1 ms for a
/// million cells.
std::optional<std::vector<Cell>> cells_changed(const GridMap& before, const GridMap& now, std::size_t most);

}  // namespace outrider
