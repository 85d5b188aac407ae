// Runs of a grid: what a cell tells of a run along one of the eight moves follows from the next cell on it.
#pragma once

#include <stop_token>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// Returns the step of a move in the arrays of a map.
inline std::ptrdiff_t step_of(const GridMap& ground, unsigned move) {
  return grid_moves[move].y * static_cast<std::ptrdiff_t>(ground.stride) + grid_moves[move].x;
}

/// Calls visit(vertex, next) for each vertex from which the move is legal, with the vertex to which it leads;
/// on each run the last one comes first. Vertices by index of the map. Only some after a stop request.
template <class Visit>
void backwards_along(const GridMap& ground, unsigned move, Visit visit, const std::stop_token& stop = {}) {
  const Cell d = grid_moves[move];
  const int width = ground.frame.width, height = ground.frame.height;
  const std::ptrdiff_t step = step_of(ground, move);
  for (int i = 0; i < height && !stop.stop_requested(); ++i) {
    const int y = d.y > 0 ? height - 1 - i : i;
    for (int j = 0; j < width; ++j) {
      const std::size_t v = ground.index({d.x > 0 ? width - 1 - j : j, y});
      if (((ground.moves[v] >> move) & 1U) == 0) continue;
      visit(v, static_cast<std::size_t>(static_cast<std::ptrdiff_t>(v) + step));
    }
  }
}

}  // namespace outrider
