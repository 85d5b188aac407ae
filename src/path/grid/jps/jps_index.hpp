// The index of jump point search: the length of each of the eight runs from each cell.
//
// 16 bytes per cell, by index of GridMap and in the order of grid_moves. A straight distance leads to the
// next cell at which a turn is forced; if there is none, it is 0 or less: minus the number of free cells
// ahead. A diagonal distance leads to the next cell from which one of the two straight runs beside it ends at
// such a turn; if there is none, it is minus the number of legal steps. Construction takes O(cells).
#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider::jump {

using Distances = std::array<std::int16_t, 8>;

/// Longest side of a grid whose distances fit.
inline constexpr int longest_indexed_side = 32767;

/// Returns the sides (of jps_map.hpp) on which a turn is forced at a vertex reached in a straight direction,
/// by its legal moves: the move to the side is legal, the one back on that side is not.
unsigned forced_sides(unsigned moves, unsigned direction);

/// Returns the diagonal move with these two straight components.
constexpr unsigned diagonal_of(unsigned horizontal, unsigned vertical) {
  const bool to_east = horizontal == 0, to_north = vertical == 1;
  if (to_north) return to_east ? 4 : 5;
  return to_east ? 7 : 6;
}

/// Returns the distances of all vertices; they are meaningless after a stop request.
std::vector<Distances> distances_of(const GridMap& ground, const std::stop_token& stop = {});

/// Updates the distances of a ground that differs in those cells to this ground; the result equals distances
/// computed from scratch. Each run is followed backwards from a change until a distance stays the same:
/// O(changed distances + changed cells).
void walk_again(std::vector<Distances>& distances, const GridMap& ground, const std::vector<Cell>& changed);

}  // namespace outrider::jump
