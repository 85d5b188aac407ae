// A grid as bits, for jump point search.
//
// There are four copies, one for each straight direction, so that every straight move runs along a line of
// bits towards the higher ones: rows to the east, reversed rows to the west, columns to the north, reversed
// columns to the south. Cells are counted from the border around the grid. The border is blocked, and so are
// all bits after it. Half a byte per cell.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider::jump {

/// The first four of grid_moves. Sides of a line are "lower" and "higher": south and north of a row,
/// west and east of a column.
enum Direction : std::uint8_t { east, north, west, south };
constexpr bool horizontal(unsigned d) { return (d & 1U) == 0; }

inline constexpr std::uint8_t lower = 1;
inline constexpr std::uint8_t higher = 2;
constexpr Direction side_of(unsigned d, unsigned side) {
  if (horizontal(d)) return side == lower ? south : north;
  return side == lower ? west : east;
}

struct Lines {
  std::vector<std::uint64_t> bits;  ///< 1 where blocked
  std::ptrdiff_t stride = 0;        ///< length of a line in words
};

/// The cell at which a run along a line ends, and the sides on which a turn is forced there.
struct Stop {
  std::int32_t position = 0;
  std::uint8_t sides = 0;  ///< 0: the cell is blocked
};

/// Returns 64 bits of a line from a position on.
inline std::uint64_t window(const std::uint64_t* line, std::int32_t position) {
  const std::uint64_t* word = line + (position >> 6);
  const auto shift = static_cast<unsigned>(position & 63);
  return (word[0] >> shift) | ((word[1] << 1U) << (63U - shift));
}

/// Returns the cells beside which a blocked stretch of this line has just ended: a turn towards this line is
/// forced there.
inline std::uint64_t ends(std::uint64_t blocked) { return (blocked << 1U) & ~blocked; }

struct Map {
  int width = 0;   ///< with the border
  int height = 0;  ///< with the border
  std::array<Lines, 4> lines;

  [[nodiscard]] const std::uint64_t* line(unsigned d, Cell c) const {
    return lines[d].bits.data() + lines[d].stride * (horizontal(d) ? c.y : c.x);
  }
  [[nodiscard]] std::int32_t position(unsigned d, Cell c) const {
    if (d < west) return horizontal(d) ? c.x : c.y;
    return horizontal(d) ? width - 1 - c.x : height - 1 - c.y;
  }
  /// Returns the cell at a position of the line through c.
  [[nodiscard]] Cell cell(unsigned d, Cell c, std::int32_t p) const {
    if (d == east) return {p, c.y};
    if (d == north) return {c.x, p};
    return d == west ? Cell{width - 1 - p, c.y} : Cell{c.x, height - 1 - p};
  }
};

/// Makes the map of a ground. O(cells).
Map map_of(const GridMap& ground);

/// Updates the changed cells of the ground. O(changed).
void rewrite(Map& map, const GridMap& ground, const std::vector<Cell>& changed);

/// Returns the first cell after `position` that is blocked or at which a turn is forced. O(cells / 64).
inline Stop scan(const std::uint64_t* line, std::ptrdiff_t stride, std::int32_t position) {
  for (;; position += 63) {
    const std::uint64_t low = ends(window(line - stride, position));
    const std::uint64_t high = ends(window(line + stride, position));
    const std::uint64_t blocked = window(line, position);
    const std::uint64_t stops = (low | high | blocked) & ~std::uint64_t{1};
    if (stops == 0) continue;
    const auto at = static_cast<unsigned>(std::countr_zero(stops));
    if (((blocked >> at) & 1U) != 0) return {position + static_cast<int>(at), 0};
    return {position + static_cast<int>(at),
            static_cast<std::uint8_t>(((low >> at) & 1U) | (((high >> at) & 1U) << 1U))};
  }
}

}  // namespace outrider::jump
