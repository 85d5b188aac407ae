// A mesh follows a change of its ground where the ground has changed, and nowhere else.
//
// The polygons that touch a changed cell, its border counted, are taken out. What they held, less the cells
// that are blocked now and more those that are free now, is cut into triangles (mesh_sweep.hpp), and these
// are joined to polygons as in a mesh made anew. The border to the polygons that stay is left as it is: a
// corner that comes or goes is one of a changed cell, so all polygons at it are taken out. What comes stands
// at the end; what goes leaves a gap. The blocks that had a side here become part of the core (mesh.hpp).
//
// The polygons are as good as others, but not those of a mesh made anew, because what is joined ends
// at the border. O(k log k + cells of the new polygons) for k corners of what is taken out.
#pragma once

#include "outrider/path/mesh/mesh.hpp"

namespace outrider {

/// `ground` is that of the mesh but for the cells `changed`, given by row, then by column. False, the mesh
/// being of no use any more, when with the gaps there would be more than `most_sides`: then it is time to
/// make it anew.
bool change_mesh(NavigationMesh& mesh, const GridMap& ground, const std::vector<Cell>& changed,
                 std::size_t most_sides);

}  // namespace outrider
