// Published grids for benchmarks, found in a folder.
//
// A map is a file that ends in .map, with its queries beside it in <name>.map.scen. The true shortest lengths
// in any direction of a sample of them are in anyangle/<name>.csv: lines
// "sx,sy,gx,gy,octile_cells,anyangle_opt" after a header, rows counted from the top. Any of these files may
// be gzip-compressed, with .gz after the name.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::bench {

struct GridFiles {
  std::string name;  ///< name of the map, without folder and extensions
  std::string set;   ///< folder of the map
  std::string map;
  std::string scenario;   ///< empty if there is none
  std::string any_angle;  ///< empty if there is none
};

/// Returns the maps under a folder that have queries, sorted by path. Refuses a missing folder, one without
/// such maps, or one with more than 100,000 files.
Outcome<std::vector<GridFiles>> find_grids(const std::string& folder);

struct GridQueryRow {
  Cell start;  ///< rows counted from the bottom
  Cell goal;
  double octile_length = 0.0;             ///< published, in cells
  std::optional<double> shortest_length;  ///< any-angle, between the top left corners of cells
};

struct PublishedGrid {
  Grid<std::uint8_t> blocked;
  std::vector<GridQueryRow> rows;
  double octile_tolerance = 1e-5;  ///< relative; infinite if the published lengths cannot be used
};

/// Loads a grid with at most so many rows, spread evenly. The rows come from the any-angle table if there is
/// one; otherwise, or with `all_rows`, from the scenario.
Outcome<PublishedGrid> load_grid(const GridFiles& files, std::size_t most_rows, bool all_rows);

}  // namespace outrider::bench
