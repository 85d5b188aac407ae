// How far each of the eight runs goes from each cell, for jump point search on one grid many times.
//
// 16 bytes a cell, by index of GridMap and in the order of grid_moves. A straight distance is that
// to the next cell at which a turn is forced, or 0 or less when there is none: minus the free
// cells ahead. A diagonal distance is that to the next cell from which a straight run of the two
// beside it ends at such a turn, or minus the steps that are legal. O(cells) to build.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider::jump {

using Distances = std::array<std::int16_t, 8>;

/// The longest side of a grid whose distances fit.
inline constexpr int longest_indexed_side = 32767;

/// The sides (of jps_map.hpp) on which a turn is forced at a vertex reached in a straight direction, by
/// its legal moves: the move to the side is legal, the one back on that side is not.
unsigned forced_sides(unsigned moves, unsigned direction);

/// The diagonal one of grid_moves that goes along both.
constexpr unsigned diagonal_of(unsigned horizontal, unsigned vertical) {
  const bool to_east = horizontal == 0, to_north = vertical == 1;
  if (to_north) return to_east ? 4 : 5;
  return to_east ? 7 : 6;
}

std::vector<Distances> distances_of(const GridMap& ground);

/// Makes the distances of a ground that differs in those cells into the distances of this one, which are
/// then the same as made anew. Each run is walked backwards from where what it depends on has changed, until
/// a distance stays as it was: O(distances that change, and the changed cells).
void walk_again(std::vector<Distances>& distances, const GridMap& ground, const std::vector<Cell>& changed);

}  // namespace outrider::jump
