// Adds polygons to a mesh, with the turns at their corners and the cells that they hold.
#pragma once

#include "mesh_polygons.hpp"
#include "outrider/path/mesh/mesh.hpp"

namespace outrider {

/// Adds polygons. `corners` are the corners that the polygons refer to, by row, then by column. Turns of the
/// mesh at these corners keep their indices (from `known`) and the polygons around them. Sides without a
/// polygon behind them stay so, and the caller must update the blocks. A stop leaves the mesh unusable.
/// O(sides + turns + cells held).
void add_polygons(NavigationMesh& mesh, const GridMap& ground, const std::vector<Cell>& corners,
                  const ConvexPolygons& polygons, const std::vector<std::uint32_t>& known = {},
                  const std::stop_token& stop = {});

}  // namespace outrider
