// GridMap: the ground as a grid of free and blocked cells, prepared for searching.
//
// Two models say where a path may run. Outside the grid everything is blocked.
//   cells    Vertices are the centres of free cells. A leg is legal when no blocked cell touches it,
//            closed squares counted; so a diagonal move needs both cells beside it (the rule of the
//            MovingAI benchmarks).
//   corners  Vertices are the corners of cells. A leg is legal when it stays out of the interior of
//            the union of the blocked cells: it may run along the border of a blocked cell, not
//            between two that share a side. It may not pass through a pinch, a corner where two
//            blocked cells meet diagonally alone; a path may start or end there.
// In both, every point of a legal leg lies in a closed free cell. Vertices and cells are counted from
// the lowest corner; the vertex (x, y) of `corners` is the lowest corner of the cell (x, y).
// Making one costs O(cells) and two bytes a cell. Thread rule: read only once made; a changed map is another
// ground, made with(), and what a planner keeps in its workspace follows by comparing the two.
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

/// The grids that are taken: at most so many cells, and so many a side.
inline constexpr std::size_t most_grid_cells = std::size_t{1} << 25U;
inline constexpr int most_grid_side = 1 << 20U;

/// Fault when a frame has no cells, too many, or numbers that are not finite.
Status check_frame(const GridFrame& frame);

/// The eight moves, straight ones first; bit i of a vertex's mask stands for moves[i].
inline constexpr std::array<Cell, 8> grid_moves = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// A rectangle of cells that become blocked, or free.
struct CellChange {
  Cell low;  ///< its cell of the least x and y
  int width = 1;
  int height = 1;
  bool blocked = true;
};

struct GridMap {
  GridFrame frame;  ///< of the cells
  GridModel model = GridModel::cells;
  std::uint32_t stride = 0;         ///< of a row in the arrays, which have a border of one cell
  std::vector<std::uint8_t> marks;  ///< by index(): the bits below
  std::vector<std::uint8_t> moves;  ///< by index(): which grid_moves are legal from that vertex

  static constexpr std::uint8_t blocked_bit = 1;  ///< of the cell
  static constexpr std::uint8_t place_bit = 2;    ///< of the vertex: a path may stand there
  static constexpr std::uint8_t pinch_bit = 4;    ///< of the vertex: a path may only start or end there

  /// Cells other than 0 are blocked. Fault: bad_input on a frame that check_frame() refuses, or when
  /// the cells do not fill it.
  static Outcome<GridMap> of(const Grid<std::uint8_t>& blocked, GridModel model);

  /// This ground after the changes, one after the other: the same as one made anew. A copy, and O(1) for
  /// each cell of a change. Fault: bad_input on a rectangle that is empty or leaves the grid.
  [[nodiscard]] Outcome<GridMap> with(const std::vector<CellChange>& changes) const;

  /// Index of a cell or of a vertex; both may lie one step outside the grid.
  [[nodiscard]] std::uint32_t index(Cell c) const {
    return static_cast<std::uint32_t>(c.y + 1) * stride + static_cast<std::uint32_t>(c.x + 1);
  }
  [[nodiscard]] Cell at(std::uint32_t index) const {
    return {static_cast<int>(index % stride) - 1, static_cast<int>(index / stride) - 1};
  }
  /// True for cells outside the grid as well.
  [[nodiscard]] bool blocked(Cell c) const {
    return !frame.contains(c) || (marks[index(c)] & blocked_bit) != 0;
  }
  /// True when v is one of the vertices of the grid.
  [[nodiscard]] bool contains(Cell v) const {
    const int more = model == GridModel::corners ? 1 : 0;
    return v.x >= 0 && v.y >= 0 && v.x < frame.width + more && v.y < frame.height + more;
  }
  /// True when a path may start or end at v.
  [[nodiscard]] bool place(Cell v) const { return contains(v) && (marks[index(v)] & place_bit) != 0; }
  [[nodiscard]] bool pinch(Cell v) const { return contains(v) && (marks[index(v)] & pinch_bit) != 0; }
  /// Where a vertex lies, m.
  [[nodiscard]] Vec2 point(Cell v) const {
    return model == GridModel::cells ? frame.centre(v) : frame.corner(v);
  }
  /// The vertex of a point: of the cell that holds it, or the nearest corner. Nothing outside the grid.
  [[nodiscard]] std::optional<Cell> vertex_at(Vec2 p) const;
};

/// The cells that are blocked in one ground and free in the other, row by row. Nothing when their frames or
/// models differ, or more than `most` cells do. One pass over the marks: 0.1 ms for a million cells.
std::optional<std::vector<Cell>> cells_changed(const GridMap& before, const GridMap& now, std::size_t most);

}  // namespace outrider
