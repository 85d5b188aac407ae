// MoveGraph: the moves of a grid as a graph, for libraries of graphs.
#pragma once

#include <utility>
#include <vector>

namespace outrider::bench {

/// A vertex for each cell, row by row, and an arc for each move, by source.
struct MoveGraph {
  int side = 0;  ///< cells in a row; vertex v is the cell (v % side, v / side)
  std::vector<std::pair<int, int>> arcs = {};
  std::vector<double> lengths = {};  ///< by arc
};

}  // namespace outrider::bench
