// Cost maps: what a metre of the ground costs, from an image or an ESRI ASCII grid.
//
// PGM or PNG: one pixel for each cell of the map that it belongs to, first row on top. A white pixel costs 1
// per metre, a black one `of_black`, those between in proportion; coloured pixels count with their mean.
//
// ESRI ASCII grid (io/map/terrain.hpp): the values are costs per metre at posts in the world frame. A cell
// has the cost at its centre, interpolated between the posts; beyond the outer posts, that of the nearest
// place.
//
// Both may be gzip-compressed. Faults: bad_input with the file, and the line or cell if there is one; costs
// outside 0.001 to 1e6 (path/grid/terrain/cell_costs.hpp). Bounds: those of the readers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

/// A cost map: an image or a grid of posts.
struct CostMap {
  std::string name;   ///< path of the file, for faults
  Grid<float> image;  ///< cost per metre of each pixel, lowest row first; empty for a grid of posts
  std::optional<HeightField> posts = std::nullopt;  ///< costs per metre as heights
};

/// Reads a cost map; the format is detected by the first bytes. `of_black` is the cost per metre of a black
/// pixel, 1 or more.
Outcome<CostMap> load_cost_map(const std::string& path, double of_black);

/// Returns the cost per metre of each cell of a grid that is turned by `yaw_rad` about its origin. Fault:
/// bad_input with the file for an image of another size. O(cells).
Outcome<Grid<float>> costs_of(const CostMap& map, const GridFrame& frame, double yaw_rad);

}  // namespace outrider
