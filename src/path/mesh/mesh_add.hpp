// Adds polygons to a mesh, with the turns at their corners and the cells that they hold.
#pragma once

#include "mesh_polygons.hpp"
#include "outrider/path/mesh/mesh.hpp"

namespace outrider {

/// `corners` are those that the polygons name, by row, then by column. Turns that the mesh has at some of
/// them keep their names, from `known`, and the polygons around them. Sides without a polygon behind them are
/// left so, and blocks are left to the caller. O(sides + turns + cells held).
void add_polygons(NavigationMesh& mesh, const GridMap& ground, const std::vector<Cell>& corners,
                  const ConvexPolygons& polygons, const std::vector<std::uint32_t>& known = {});

}  // namespace outrider
