// Updates a mesh after a change of its ground, only where the ground has changed.
//
// The polygons that touch a changed cell (including its border) are removed. Their area, minus the cells that
// are blocked now and plus those that are free now, is cut into triangles (mesh_sweep.hpp), which are merged
// into polygons as in a new mesh. The border to the remaining polygons stays unchanged: a corner that appears
// or disappears is a corner of a changed cell, so all polygons at it are removed. New polygons are appended;
// removed ones leave gaps. The blocks that had a side here become part of the core (mesh.hpp).
//
// The mesh is valid, but its polygons differ from those of a new mesh, because merging stops at the border.
// O(k log k + cells of the new polygons) for k corners of the removed area.
#pragma once

#include "outrider/path/mesh/mesh.hpp"

namespace outrider {

/// Updates the mesh to `ground`, which differs from its ground in the cells `changed`, given by row, then by
/// column. Returns false if sides and gaps would exceed `most_sides`; the mesh is then unusable and must be
/// rebuilt.
bool change_mesh(NavigationMesh& mesh, const GridMap& ground, const std::vector<Cell>& changed,
                 std::size_t most_sides);

}  // namespace outrider
