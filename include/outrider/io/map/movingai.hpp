// MovingAI benchmark maps and scenarios.
//
// A map is "type octile", "height H", "width W", "map", then H rows of W letters, beginning with the top row.
// '.', 'G' and 'S' are passable; '@', 'O', 'T' and 'W' are blocked (water cannot be entered from land). A
// scenario has one query per line: bucket map W H sx sy gx gy length, with y counted from the top. Rows are
// flipped: row 0 of the Grid is the lowest, and queries are given in cells of that Grid. The Grid has its
// origin at (0, 0) and cells of 1 m. Files may be gzip-compressed.
//
// Faults: bad_input with file:line. Bounds: sides up to 100,000, 100 million cells; a million queries.
// Source: Sturtevant, Benchmarks for Grid-Based Pathfinding, 2012.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Loads a map. Blocked cells are 1, passable ones 0.
Outcome<Grid<std::uint8_t>> load_movingai_map(const std::string& path);
Outcome<Grid<std::uint8_t>> movingai_map_from_text(std::string_view text, const std::string& name);

struct MovingAiQuery {
  int bucket = 0;
  std::string map;  ///< name of the map, as written in the file
  int width = 0;
  int height = 0;
  Cell start;
  Cell goal;
  double octile_length = 0.0;  ///< optimal length, 8-connected without corner cutting, in cells
};

Outcome<std::vector<MovingAiQuery>> load_movingai_scenario(const std::string& path);
Outcome<std::vector<MovingAiQuery>> movingai_scenario_from_text(std::string_view text,
                                                                const std::string& name);

}  // namespace outrider
