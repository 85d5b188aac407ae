// Grid<T>: values in square cells of equal size, stored row by row from the lowest y.
//
// A Cell (column, row) is an index; world coordinates are in metres; centre() and corner() convert a cell to
// world coordinates. Row 0 is the lowest: images and MovingAI files, whose first row is the top, are flipped
// when they are read.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

/// Indices of a cell.
struct Cell {
  int x = 0;  ///< column
  int y = 0;  ///< row
  friend constexpr bool operator==(Cell, Cell) = default;
};

/// Position and size of a grid. Cell (0, 0) extends from the origin to origin + resolution in x and y.
struct GridFrame {
  Vec2 origin;                ///< lowest corner of cell (0, 0), m
  double resolution_m = 1.0;  ///< side of a cell
  int width = 0;              ///< columns
  int height = 0;             ///< rows

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] bool contains(Cell c) const { return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height; }
  [[nodiscard]] std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.x);
  }
  [[nodiscard]] Cell cell(std::size_t index) const {
    const auto columns = static_cast<std::size_t>(width);
    return {static_cast<int>(index % columns), static_cast<int>(index / columns)};
  }
  [[nodiscard]] Vec2 centre(Cell c) const {
    return {origin.x + (c.x + 0.5) * resolution_m, origin.y + (c.y + 0.5) * resolution_m};
  }
  /// Returns the corner of a cell with the lowest x and y, m.
  [[nodiscard]] Vec2 corner(Cell c) const {
    return {origin.x + c.x * resolution_m, origin.y + c.y * resolution_m};
  }
  /// Returns the cell that contains a point; it may lie outside the grid. The point must be finite and at
  /// most 1e9 cells away from the origin.
  [[nodiscard]] Cell cell_at(Vec2 p) const {
    return {static_cast<int>(std::floor((p.x - origin.x) / resolution_m)),
            static_cast<int>(std::floor((p.y - origin.y) / resolution_m))};
  }
  [[nodiscard]] Box2 bounds() const {
    return {origin, {origin.x + width * resolution_m, origin.y + height * resolution_m}};
  }
  friend bool operator==(const GridFrame&, const GridFrame&) = default;
};

/// Returns the smallest grid that covers the box. It is centred on the box.
inline GridFrame covering(const Box2& box, double resolution_m) {
  const auto cells = [&](double size) { return static_cast<int>(std::ceil(size / resolution_m - 1e-9)); };
  GridFrame frame;
  frame.resolution_m = resolution_m;
  frame.width = cells(box.size().x);
  frame.height = cells(box.size().y);
  frame.origin =
      0.5 * (box.low + box.high) -
      0.5 * resolution_m * Vec2{static_cast<double>(frame.width), static_cast<double>(frame.height)};
  return frame;
}

/// Copies cell values to another frame: the value at cell c moves to cell c + shift, unless that is outside
/// `to`. All other cells get the value `rest`. O(cells).
template <class T>
std::vector<T> moved_cells(const std::vector<T>& cells, const GridFrame& from, const GridFrame& to,
                           Cell shift, T rest) {
  std::vector<T> moved(to.size(), rest);
  const int begin = std::max(0, -shift.x), end = std::min(from.width, to.width - shift.x);
  if (begin >= end) return moved;
  for (int y = std::max(0, -shift.y); y < std::min(from.height, to.height - shift.y); ++y) {
    const auto at = [](std::size_t index) { return static_cast<std::ptrdiff_t>(index); };
    std::copy_n(cells.begin() + at(from.index({begin, y})), end - begin,
                moved.begin() + at(to.index({begin + shift.x, y + shift.y})));
  }
  return moved;
}

/// A grid of values.
template <class T>
struct Grid {
  GridFrame frame;
  std::vector<T> cells;

  Grid() = default;
  explicit Grid(const GridFrame& where, T value = {}) : frame(where), cells(where.size(), value) {}

  T& operator[](Cell c) { return cells[frame.index(c)]; }
  const T& operator[](Cell c) const { return cells[frame.index(c)]; }
  [[nodiscard]] bool contains(Cell c) const { return frame.contains(c); }
};

}  // namespace outrider
