// Published grids to measure planners on, found in a folder.
//
// A map is a file that ends in .map, its queries stand beside it in <name>.map.scen, and the true shortest
// lengths in any direction of a sample of them in anyangle/<name>.csv: lines
// "sx,sy,gx,gy,octile_cells,anyangle_opt" after a head, rows counted from the top. Any of these may be
// gzip-compressed, with .gz after the name.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::bench {

struct GridFiles {
  std::string name;  ///< of the map, without folder and endings
  std::string set;   ///< the folder that it stands in
  std::string map;
  std::string scenario;   ///< empty: none
  std::string any_angle;  ///< empty: none
};

/// The maps under a folder that have queries, in order of their paths. Refused: no folder, none of them, or
/// more than 100,000 files.
Outcome<std::vector<GridFiles>> find_grids(const std::string& folder);

struct GridQueryRow {
  Cell start;  ///< rows counted from the bottom
  Cell goal;
  double octile_length = 0.0;             ///< published, in cells
  std::optional<double> shortest_length;  ///< in any direction, between the top left corners of the cells
};

struct PublishedGrid {
  Grid<std::uint8_t> blocked;
  std::vector<GridQueryRow> rows;
  double octile_tolerance = 1e-5;  ///< relative; infinite where the published lengths cannot be used
};

/// At most so many rows, spread evenly: of the any-angle table where there is one, else, or with
/// `all_rows`, of the scenario.
Outcome<PublishedGrid> load_grid(const GridFiles& files, std::size_t most_rows, bool all_rows);

}  // namespace outrider::bench
