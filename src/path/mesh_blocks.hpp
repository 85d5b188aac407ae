// Parts, blocks and their trees: the fields of a mesh that follow from its sides. O(sides).
#pragma once

#include "outrider/path/mesh.hpp"

namespace outrider {

void find_blocks(NavigationMesh& mesh);

}  // namespace outrider
