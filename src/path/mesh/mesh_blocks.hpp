// Blocks and their trees: the fields of a mesh that follow from its sides.
#pragma once

#include "outrider/path/mesh/mesh.hpp"

namespace outrider {

/// Finds all of them. O(sides).
void find_blocks(NavigationMesh& mesh);

/// A new block of the core.
std::uint32_t add_to_core(NavigationMesh& mesh);

/// Before a polygon is taken out: its blocks, and those between it and its root, become part of the core,
/// together with `block`, which is of the core. So no block outside the core has lost a side, and such a
/// block still hangs on one polygon. O(blocks).
void move_to_core(NavigationMesh& mesh, std::uint32_t polygon, std::uint32_t block);

}  // namespace outrider
