// Blocks and their trees: the fields of a mesh that follow from its sides.
#pragma once

#include <stop_token>

#include "outrider/path/mesh/mesh.hpp"

namespace outrider {

/// Finds all blocks; a stop leaves some out. O(sides).
void find_blocks(NavigationMesh& mesh, const std::stop_token& stop = {});

/// Adds a new block to the core.
std::uint32_t add_to_core(NavigationMesh& mesh);

/// Must be called before a polygon is removed. Its blocks, and those between it and its root, become part of
/// the core, together with `block`, which is already in the core. So no block outside the core has lost a
/// side, and each such block is still attached to one polygon. O(blocks).
void move_to_core(NavigationMesh& mesh, std::uint32_t polygon, std::uint32_t block);

}  // namespace outrider
